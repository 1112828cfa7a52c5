#include "renderer/reference/depth_reference.h"

#include "base/parallel.h"
#include "renderer/reference/sobol.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// Independent scramblings per pixel, whose spread gives the standard error.
constexpr int batches = 8;

// The relative error that float arithmetic leaves in a ray along a plane.
constexpr float tolerance = 2e-6f;

// A ray in pixels and inverse depth, both of which are linear along it on screen.
struct ScreenRay {
    glm::vec2 start, stride; // pixels; one of the stride's components is 1 or -1
    float inverse, perStep;  // inverse depth
    float steps;             // to its end, not whole
    float inverseEnd;
};

class DepthField {
  public:
    DepthField(const Surfaces& surfaces, std::optional<double> thickness)
        : surfaces_(&surfaces), thickness_(static_cast<float>(thickness.value_or(-1))),
          inverse_(surfaces.depth.size()) {
        for (std::size_t i = 0; i < inverse_.size(); ++i)
            inverse_[i] = surfaces.empty(i) ? 0 : 1 / surfaces.depth[i];
    }

    // Share of the way from `from` to `to` at which the ray is first blocked; 1 when it is not.
    float firstHit(glm::vec3 from, glm::vec3 to) const {
        const ScreenRay ray = onScreen(from, to);
        float before = 0; // how far the ray was in front of the surface, in inverse depth
        for (float i = 1;; ++i) {
            const float step = std::min(i, ray.steps);
            const glm::vec2 place = ray.start + ray.stride * step;
            const float inverse = ray.inverse + ray.perStep * step;
            if (!inside(place))
                return 1;
            const float surface = surfaceAt(place, ray.stride.x * ray.stride.x == 1, step == i);
            const float front = inverse - surface * (1 - tolerance);
            if (front < 0 && blocks(surface, inverse)) {
                const float share = before > 0 ? before / (before - front) : 0;
                const float crossing = step - (step - (i - 1)) * (1 - share);
                return crossing / ray.steps * ray.inverseEnd /
                       (ray.inverse + ray.perStep * crossing);
            }
            before = front;
            if (i >= ray.steps)
                return 1;
        }
    }

  private:
    glm::vec2 pixelOf(glm::vec3 position) const {
        const glm::vec4 map = surfaces_->frame.viewFromUv;
        const glm::vec2 uv =
            (glm::vec2(position) / -position.z - glm::vec2(map.z, map.w)) / glm::vec2(map.x, map.y);
        return uv * glm::vec2(surfaces_->width, surfaces_->height) - 0.5f;
    }

    ScreenRay onScreen(glm::vec3 from, glm::vec3 to) const {
        const float near = surfaces_->frame.depth.x;
        if (-to.z < near) // walk as far as the nearest plane
            to = glm::mix(from, to, std::max(0.0f, (-from.z - near) / (to.z - from.z)));
        const glm::vec2 start = pixelOf(from), end = pixelOf(to), way = end - start;
        const float steps = std::max(std::abs(way.x), std::abs(way.y));
        const float inverse = -1 / from.z, inverseEnd = -1 / to.z;
        if (!(steps > 1e-6f))
            return {{-2, -2}, {1, 0}, inverse, 0, 1, inverse}; // meets nothing
        return {start, way / steps, inverse, (inverseEnd - inverse) / steps, steps, inverseEnd};
    }

    bool inside(glm::vec2 place) const {
        return place.x >= 0 && place.y >= 0 &&
               place.x <= static_cast<float>(surfaces_->width - 1) &&
               place.y <= static_cast<float>(surfaces_->height - 1);
    }

    float texel(int x, int y) const {
        return inverse_[surfaces_->index(std::min(x, surfaces_->width - 1),
                                         std::min(y, surfaces_->height - 1))];
    }

    // Between pixels. At whole steps one coordinate is a pixel's centre.
    float surfaceAt(glm::vec2 place, bool alongX, bool whole) const {
        if (!whole) {
            const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
            const float across = place.x - static_cast<float>(x);
            return between(between(texel(x, y), texel(x + 1, y), across),
                           between(texel(x, y + 1), texel(x + 1, y + 1), across),
                           place.y - static_cast<float>(y));
        }
        if (alongX) {
            const int x = static_cast<int>(place.x + 0.5f), y = static_cast<int>(place.y);
            return between(texel(x, y), texel(x, y + 1), place.y - static_cast<float>(y));
        }
        const int x = static_cast<int>(place.x), y = static_cast<int>(place.y + 0.5f);
        return between(texel(x, y), texel(x + 1, y), place.x - static_cast<float>(x));
    }

    // Two surfaces that a slab of this thickness does not join count as two.
    float between(float a, float b, float share) const {
        if (thickness_ >= 0 && std::abs(a - b) > thickness_ * a * b)
            return share < 0.5f ? a : b;
        return a + (b - a) * share;
    }

    bool blocks(float surface, float inverse) const {
        return thickness_ < 0 || 1 / inverse - 1 / surface <= thickness_;
    }

    const Surfaces* surfaces_;
    float thickness_;
    std::vector<float> inverse_;
};

struct PixelSum {
    double visibility = 0, squares = 0; // of batch means
    glm::dvec3 bent{0};
};

glm::vec3 sampleDirection(Integral integral, glm::vec2 point) {
    return integral == Integral::uniform ? uniformDirection(point) : cosineDirection(point);
}

PixelSum tracePixel(const DepthField& field, glm::vec3 position, glm::vec3 normal,
                    std::uint32_t pixel, const TraceSettings& settings) {
    const glm::mat3 basis = basisAround(normal);
    const int perBatch = (settings.rays + batches - 1) / batches;
    PixelSum sum;
    for (int batch = 0; batch < batches; ++batch) {
        const auto seed = static_cast<std::uint32_t>(settings.seed) * 0x9e3779b9u ^
                          (pixel * batches + static_cast<std::uint32_t>(batch));
        double open = 0;
        for (int i = 0; i < perBatch; ++i) {
            const glm::vec3 direction =
                basis *
                sampleDirection(settings.integral, owenSobol(static_cast<std::uint32_t>(i), seed));
            const float hit = field.firstHit(
                position, position + direction * static_cast<float>(settings.radius));
            const double value = settings.integral == Integral::falloff ? static_cast<double>(hit)
                                                                        : (hit < 1 ? 0.0 : 1.0);
            open += value;
            sum.bent += glm::dvec3(direction) * value;
        }
        sum.visibility += open / perBatch / batches;
        sum.squares += open / perBatch * (open / perBatch) / batches;
    }
    return sum;
}

} // namespace

Reference depthReference(const Surfaces& surfaces, const TraceSettings& settings,
                         std::optional<double> thickness, const TraceProgress& progress) {
    const int width = surfaces.width, height = surfaces.height;
    const std::size_t count = surfaces.depth.size();
    Reference result{{width, height, 1, std::vector<float>(count, 1.0f)},
                     {width, height, 1, std::vector<float>(count, 0.0f)},
                     {width, height, 3, std::vector<float>(3 * count, 0.0f)}};
    const DepthField field(surfaces, thickness);
    const auto row = [&](int y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = surfaces.index(x, y);
            if (surfaces.empty(i) || surfaces.normal[i] == glm::vec3(0))
                continue;
            const glm::vec3 position =
                surfaces.position(static_cast<float>(x), static_cast<float>(y), surfaces.depth[i]);
            const PixelSum sum = tracePixel(field, position, surfaces.normal[i],
                                            static_cast<std::uint32_t>(i), settings);
            const int top = height - 1 - y;
            const double variance = std::max(0.0, sum.squares - sum.visibility * sum.visibility);
            result.visibility.at(x, top, 0) = static_cast<float>(sum.visibility);
            result.error.at(x, top, 0) = static_cast<float>(std::sqrt(variance / (batches - 1)));
            const glm::vec3 bent = glm::dot(sum.bent, sum.bent) > 0
                                       ? glm::vec3(glm::normalize(sum.bent))
                                       : surfaces.normal[i];
            for (int c = 0; c < 3; ++c)
                result.bentNormal.at(x, top, c) = bent[c];
        }
    };
    forEachInParallel(height, row, progress);
    return result;
}

} // namespace obscura
