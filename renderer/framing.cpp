#include "renderer/framing.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/extent.h"
#include "renderer/found_cameras.h"
#include "renderer/frame/vec3.h"
#include "renderer/glimpse.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace obscura {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double indoorFov = 60, outdoorFov = 40;
constexpr double margin = 0.88;        // of the picture, for the whole of an object
constexpr int places = 384, stood = 8; // where somebody could stand, and where he looks around
constexpr int points = 1024;           // of surfaces, to tell how much is seen
constexpr double closed = 0.75;        // of directions that meet something, in a room
constexpr double eyeHeight = 1.6;      // metres
constexpr double elbowRoom = 0.05;     // of the scene's size, where one would rather stand
constexpr double roomOfThings = 12;    // sizes of what stands in it, to be more than a backdrop

glm::dvec3 middleOf(const Bounds& bounds) {
    return 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
}

// A camera, and how good it is.
struct Look {
    Camera camera;
    double score = -1;
    double seen = 0;                    // share of the scene's surfaces that can be seen from there
    double eye = 0;                     // metres above the floor; 0 where there is none
    double narrowest = 0, farthest = 0; // as Framing has them
};

// What matters of a surface is half its area, half its detail: by area alone, bare walls behind the
// scenes count for more than all that stands in it.
std::vector<SurfacePoint> pointsOf(const Scene& scene,
                                   const std::vector<std::uint32_t>& triangles) {
    std::vector<SurfacePoint> result = surfacePoints(scene, triangles, points / 2, Spread::byArea);
    const auto detail = surfacePoints(scene, triangles, points / 2, Spread::byTriangle);
    result.insert(result.end(), detail.begin(), detail.end());
    return result;
}

// Looks for cameras in one scene.
class Scout {
  public:
    Scout(const Scene& scene, std::uint64_t seed, double aspect)
        : sight_(scene), extent_(extentOf(scene)), seed_(seed), aspect_(aspect),
          whole_(pointsOf(scene, extent_.wholeTriangles)),
          subject_(pointsOf(scene, extent_.subjectTriangles)) {}

    const Sight& sight() const { return sight_; }
    const Extent& extent() const { return extent_; }
    double aspect() const { return aspect_; }

    std::optional<Look> indoors() const;
    Look outdoors() const;
    // The file's own.
    std::optional<Look> own(const NamedCamera& camera, double least) const;
    // Of all surfaces, from there.
    double seenOfWhole(const glm::vec3& eye) const { return seenFrom(eye, whole_); }

  private:
    struct Stand {
        glm::vec3 eye{0};
        double seen = 0, height = 0, rank = 0;
    };

    double seenFrom(const glm::vec3& eye, const std::vector<SurfacePoint>& of) const;
    std::optional<Stand> standAt(const glm::vec3& point) const;
    std::vector<Stand> stands() const;
    Look lookFrom(const Stand& stand) const;
    Look fitted(double turn, double rise) const;
    double riseOf() const;

    Sight sight_;
    Extent extent_;
    std::uint64_t seed_;
    double aspect_;
    std::vector<SurfacePoint> whole_, subject_;
};

double Scout::seenFrom(const glm::vec3& eye, const std::vector<SurfacePoint>& of) const {
    double count = 0;
    for (const SurfacePoint& point : of) {
        const glm::vec3 way = point.position - eye;
        const float distance = glm::length(way);
        const int material = sight_.materialAt(point.firstIndex);
        if (!(distance > 0) ||
            (glm::dot(way, point.normal) > 0 &&
             !sight_.scene().materials[static_cast<std::size_t>(material)].doubleSided))
            continue;
        const auto met = sight_.along(eye, way / distance);
        count += !met || met->distance > 0.999f * distance;
    }
    return count / static_cast<double>(of.size());
}

bool isRoom(const Around& around, double size) {
    return around.closed > closed && around.backs < 0.4 && around.nearest > 0.01 * size;
}

// Where somebody would stand whose column of air the point is in; none where he could not, or where
// it is not in a room.
std::optional<Scout::Stand> Scout::standAt(const glm::vec3& point) const {
    const glm::vec3 up(0, 1, 0);
    const double size = diagonal(extent_.whole);
    Stand stand{point};
    const auto floor = sight_.along(point, -up);
    if (floor && floor->faceNormal.y > 0.7f) {
        const glm::vec3 foot = point - up * (floor->distance - static_cast<float>(1e-5 * size));
        const auto ceiling = sight_.along(foot, up);
        const double high = ceiling ? static_cast<double>(ceiling->distance)
                                    : static_cast<double>(extent_.whole.high.y - foot.y);
        stand.height = std::max(std::min(eyeHeight, 0.55 * high), high / 8);
        stand.eye = foot + up * static_cast<float>(stand.height);
    }
    const Around walls = around(sight_, stand.eye);
    if (!isRoom(walls, size))
        return {};
    stand.seen = seenFrom(stand.eye, whole_);
    stand.rank = stand.seen * std::min(1.0, walls.nearest / (elbowRoom * size));
    return stand;
}

// The best places to stand, apart from each other.
std::vector<Scout::Stand> Scout::stands() const {
    Random random(seed_, "framing");
    const glm::vec3 low = extent_.whole.low, size = extent_.whole.high - low;
    std::vector<glm::vec3> at;
    for (int i = 0; i < places; ++i) {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        at.push_back(low + size * glm::vec3(x, y, z));
    }
    std::vector<std::optional<Stand>> all(at.size());
    forEachInParallel(at.size(), [&](std::size_t i) { all[i] = standAt(at[i]); });
    std::vector<Stand> found;
    for (const std::optional<Stand>& stand : all)
        if (stand)
            found.push_back(*stand);
    std::stable_sort(found.begin(), found.end(),
                     [](const Stand& a, const Stand& b) { return a.rank > b.rank; });
    std::vector<Stand> taken;
    for (const Stand& stand : found)
        if (taken.size() < stood &&
            std::none_of(taken.begin(), taken.end(), [&](const Stand& other) {
                return glm::distance(stand.eye, other.eye) < 0.06f * glm::length(size);
            }))
            taken.push_back(stand);
    return taken;
}

Look Scout::lookFrom(const Stand& stand) const {
    const double size = diagonal(extent_.whole);
    Look best;
    best.seen = stand.seen;
    best.eye = stand.height;
    for (int step = 0; step < 24; ++step)
        for (const double rise : {-0.05, 0.08}) {
            const double turn = 2 * pi * step / 24;
            Camera camera;
            camera.fovDegrees = indoorFov;
            camera.position = arrayOf(glm::dvec3(stand.eye));
            camera.target =
                arrayOf(glm::dvec3(stand.eye) +
                        size * glm::normalize(glm::dvec3(std::sin(turn), rise, std::cos(turn))));
            const Glimpse at = glimpse(sight_, camera, aspect_, size);
            const double score = at.variety * at.shown * at.shown *
                                 std::min(1.0, at.near / (0.04 * size)) *
                                 std::min(1.0, at.middle / (0.25 * size)) * std::sqrt(stand.seen);
            if (score > best.score) {
                best.score = score;
                best.camera = camera;
            }
        }
    return best;
}

std::optional<Look> Scout::indoors() const {
    if (extent_.surroundings && diagonal(extent_.whole) > roomOfThings * diagonal(extent_.subject))
        return {};
    const std::vector<Stand> at = stands();
    std::vector<Look> looks(at.size());
    forEachInParallel(at.size(), [&](std::size_t i) { looks[i] = lookFrom(at[i]); });
    std::optional<Look> found;
    for (const Look& look : looks)
        if (!found || look.score > found->score)
            found = look;
    return found;
}

// Tall things are seen from slightly above, flat ones from higher up.
double Scout::riseOf() const {
    const glm::dvec3 size(extent_.subject.high - extent_.subject.low);
    const double flat = std::clamp(1 - size.y / std::max({size.x, size.z, 1e-30}) * 1.25, 0.0, 1.0);
    return (12 + 20 * flat) * pi / 180;
}

// The nearest camera from that side that has all of the subject in its picture, with a margin.
Look Scout::fitted(double turn, double rise) const {
    const glm::dvec3 back(std::sin(turn) * std::cos(rise), std::sin(rise),
                          std::cos(turn) * std::cos(rise)),
        right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right),
        middle = middleOf(extent_.subject);
    const double tanY = margin * std::tan(outdoorFov / 2 * pi / 180), tanX = tanY * aspect_;
    // A point (x, y, z) is in the picture of a camera at (cx, cy, cz), in these axes, if
    // |x - cx| < tanX (cz - z), and the same with y: each border is the farthest of planes.
    double left = 1e300, rightmost = -1e300, low = 1e300, high = -1e300, nearest = -1e300,
           farthest = 1e300;
    const auto forEachCorner = [&](const auto& use) {
        for (const std::uint32_t first : extent_.subjectTriangles)
            for (std::uint32_t i = first; i < first + 3; ++i) {
                const glm::dvec3 from =
                    glm::dvec3(sight_.scene().vertices[sight_.scene().indices[i]].position) -
                    middle;
                use(glm::dot(from, right), glm::dot(from, up), glm::dot(from, back));
            }
    };
    forEachCorner([&](double x, double y, double z) {
        left = std::min(left, x - tanX * z);
        rightmost = std::max(rightmost, x + tanX * z);
        low = std::min(low, y - tanY * z);
        high = std::max(high, y + tanY * z);
        nearest = std::max(nearest, z);
        farthest = std::min(farthest, z);
    });
    const double away = std::max({(rightmost - left) / (2 * tanX), (high - low) / (2 * tanY),
                                  nearest + 0.02 * diagonal(extent_.subject)});
    Look look;
    look.farthest = away - farthest;
    const double across = (left + rightmost) / 2;
    forEachCorner([&](double x, double, double z) {
        look.narrowest = std::max(look.narrowest, std::abs(x - across) / (tanY * (away - z)));
    });
    look.camera.fovDegrees = outdoorFov;
    const glm::dvec3 axis = middle + right * across + up * ((low + high) / 2);
    look.camera.position = arrayOf(axis + back * away);
    look.camera.target = arrayOf(axis);
    return look;
}

Look Scout::outdoors() const {
    Look found;
    const std::array turns{35.0, -35.0, 0.0, 90.0, -90.0, 145.0, -145.0, 180.0};
    std::vector<Look> looks(turns.size());
    forEachInParallel(turns.size(), [&](std::size_t i) {
        const double turn = turns[i] * pi / 180;
        looks[i] = fitted(turn, riseOf());
        const glm::vec3 eye(vec(looks[i].camera.position));
        looks[i].seen = seenFrom(eye, whole_);
        const double seen = seenFrom(eye, subject_);
        const bool threeQuarter = std::abs(std::sin(2 * turn)) > 0.1;
        looks[i].score = seen * (1 + 0.25 * std::cos(turn)) * (threeQuarter ? 1.25 : 1);
    });
    for (const Look& look : looks)
        if (look.score > found.score)
            found = look;
    return found;
}

std::optional<Look> Scout::own(const NamedCamera& named, double least) const {
    if (!faultOf(named.camera).empty())
        return {};
    Look look;
    look.camera = named.camera;
    // Files give a camera's own upward direction; where it is not rolled, that of the world will
    // do.
    const glm::dvec3 ahead = glm::normalize(vec(look.camera.target) - vec(look.camera.position)),
                     right = glm::normalize(glm::cross(ahead, vec(look.camera.up)));
    if (std::abs(right.y) < 1e-4 && look.camera.up[1] > 0)
        look.camera.up = {0, 1, 0};
    const Glimpse at = glimpse(sight_, named.camera, aspect_, diagonal(extent_.whole));
    look.seen = seenFrom(glm::vec3(vec(named.camera.position)), whole_);
    if (at.shown < 0.12 || look.seen < least)
        return {};
    return look;
}

// To a ten-thousandth of `size`, or a little finer, so that a person can read and type it.
Vec3 rounded(const Vec3& v, double size) {
    const double per = std::pow(10, std::ceil(-std::log10(size * 1e-4)));
    const auto round = [&](double x) { return std::round(x * per) / per + 0.0; }; // no -0
    return {round(v[0]), round(v[1]), round(v[2])};
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

} // namespace

Framing framing(const Scene& scene, const RayTracer& tracer, std::uint64_t seed, double aspect) {
    const Scout scout(scene, seed, aspect);
    const Extent& extent = scout.extent();
    const std::optional<Look> indoors = scout.indoors();
    const Look outdoors = scout.outdoors();
    Framing result;
    Look chosen = outdoors;
    result.inside = indoors && indoors->seen > outdoors.seen;
    if (result.inside) {
        chosen = *indoors;
        result.why = fmt::format(
            "The camera stands in a room{}: {} of all surfaces can be seen from there, and {} from "
            "outside.",
            chosen.eye > 0 ? fmt::format(", {:.3g} m above its floor", chosen.eye) : "",
            percent(chosen.seen), percent(outdoors.seen));
    } else
        result.why = fmt::format(
            "The camera sees the whole of it from outside: {} of all surfaces can be seen from "
            "there, and {}.",
            percent(outdoors.seen),
            indoors ? percent(indoors->seen) + " from within" : "nowhere is it closed like a room");
    for (const NamedCamera& named : scene.cameras)
        if (const auto own = scout.own(named, 0.25 * chosen.seen)) {
            chosen = *own;
            result.inside = isRoom(around(scout.sight(), glm::vec3(vec(own->camera.position))),
                                   diagonal(extent.whole));
            result.why = fmt::format("The camera is the file's own{}: {} of all surfaces can be "
                                     "seen from there.",
                                     named.name.empty() ? "" : ", \"" + named.name + "\"",
                                     percent(own->seen));
            break;
        }
    if (extent.crumbs)
        result.why += " What is small and far from everything else was left out.";
    if (extent.surroundings && !result.inside)
        result.why += " The picture is of where its detail is; what is large and plain around it, "
                      "such as a floor, may reach beyond.";
    const double size = diagonal(result.inside ? extent.whole : extent.subject);
    result.camera = chosen.camera;
    result.narrowest = chosen.narrowest;
    result.farthest = chosen.farthest;
    const Glimpse at = glimpse(scout.sight(), result.camera, aspect, size);
    if (at.shown <= 0)
        throw Error("expected surfaces that can be seen, found none from any side: they face away "
                    "(make the materials double-sided) or their masks cut all of them out");
    result.camera.target = arrayOf(
        vec(chosen.camera.position) +
        at.middle * glm::normalize(vec(chosen.camera.target) - vec(chosen.camera.position)));
    for (Vec3* each : {&result.camera.position, &result.camera.target})
        *each = rounded(*each, size);
    result.near = std::clamp(roundRadius(std::min(size / 1000, at.first / 2)), 1e-7, 1e3);
    result.camera.near = result.near;
    const SuggestedRadius radius =
        suggestedRadius(scout.sight(), tracer, std::span(&result.camera, 1));
    result.radius = radius.metres;
    result.why += fmt::format(" Near plane {:g} m: {}. Radius {:g} m: {}.", result.near,
                              at.first / 2 < size / 1000
                                  ? "half as far as the nearest surface in the picture"
                                  : fmt::format("a thousandth of its size, {:.3g} m", size),
                              result.radius, radius.why);
    return result;
}

Camera fitted(const Framing& framing, double aspect) {
    Camera camera = framing.camera;
    if (!(framing.farthest > 0) || !(aspect < framing.narrowest))
        return camera;
    // What is d away may be d tan(half the angle) to the side: less by the ratio of the shapes,
    // which a step back by d times (ratio - 1) makes up for; most of it for the farthest.
    const double step = framing.farthest * (framing.narrowest / aspect - 1);
    camera.position = arrayOf(vec(camera.position) -
                              step * glm::normalize(vec(camera.target) - vec(camera.position)));
    return camera;
}

} // namespace obscura
