#pragma once

// The one place that knows Embree 3 (Debian 12 has 3.13) from Embree 4: they differ in the header's
// name and in how a query is called. CMake says which of the two was found.
#if OBSCURA_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <type_traits>

namespace obscura {

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease>;
using EmbreeGeometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeRelease>;

// findAny() sets a ray's tfar to -infinity where it meets anything; findNearest() sets it to the
// distance of the nearest thing met. `valid` has -1 for the lanes that count, 0 for others. Embree
// is told whether the rays of a packet run through the same boxes.
enum class Coherence { packet, none };

#if OBSCURA_EMBREE >= 4
inline void findAny(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, nullptr); }

inline void findAny(RTCScene scene, const int* valid, RTCRay16& rays,
                    Coherence coherence = Coherence::packet) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = coherence == Coherence::packet ? RTC_RAY_QUERY_FLAG_COHERENT
                                                     : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcOccluded16(valid, scene, &rays, &arguments);
}

inline void findNearest(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray, nullptr); }

inline void findNearest(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &arguments);
}
#else
inline RTCIntersectContext embreeContext(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

inline void findAny(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context = embreeContext(RTC_INTERSECT_CONTEXT_FLAG_NONE);
    rtcOccluded1(scene, &context, &ray);
}

inline void findAny(RTCScene scene, const int* valid, RTCRay16& rays,
                    Coherence coherence = Coherence::packet) {
    RTCIntersectContext context =
        embreeContext(coherence == Coherence::packet ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded16(valid, scene, &context, &rays);
}

inline void findNearest(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context = embreeContext(RTC_INTERSECT_CONTEXT_FLAG_NONE);
    rtcIntersect1(scene, &context, &ray);
}

inline void findNearest(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectContext context = embreeContext(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect16(valid, scene, &context, &rays);
}
#endif

} // namespace obscura
