// obscura-metric-time METRIC TEST REFERENCE [TIMES]: the least CPU seconds and seconds that "jod",
// "map" (JOD with its map), "flip" or "ssim" takes for two pictures, the memory by which the
// process grew at its peak, floats a pixel, and the value.

#include "base/csv.h"
#include "base/error.h"
#include "metrics/color_video_vdp.h"
#include "metrics/flip.h"
#include "metrics/image_error.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace obscura {

namespace {

double megabytesAtPeak() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

double valueOf(const std::string& metric, const Image8& test, const Image8& reference) {
    if (metric == "jod" || metric == "map")
        return predictedDifference(test, reference, displays().front(), metric == "map").jod;
    if (metric == "flip")
        return flipError(test, reference).mean;
    if (metric == "ssim") {
        const Image a = lumaOf(test), b = lumaOf(reference);
        return structuralSimilarity(a, b, std::vector<bool>(a.pixels.size(), true));
    }
    throw Error(fmt::format("expected jod, map, flip or ssim, found \"{}\"", metric));
}

int timeMetric(int argc, char** argv) {
    int times = 5;
    if (argc < 4 || argc > 5 || (argc == 5 && (!readCell(argv[4], times) || times < 1)))
        throw Error("expected METRIC TEST REFERENCE [TIMES], such as jod a.png b.png 5");
    const Image8 test = readImage8(argv[2], 3), reference = readImage8(argv[3], 3);
    const double before = megabytesAtPeak();
    double cpu = std::numeric_limits<double>::infinity(), wall = cpu, value = 0;
    for (int i = 0; i < times; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t clock = std::clock();
        value = valueOf(argv[1], test, reference);
        cpu = std::min(cpu, static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        wall = std::min(wall, took.count());
    }
    fmt::print("{:.4f} {:.4f} {:.1f} {:.5f}\n", cpu, wall,
               (megabytesAtPeak() - before) * 1024 * 1024 / sizeof(float) /
                   (static_cast<double>(test.width) * test.height),
               value);
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-metric-time", obscura::timeMetric, argc, argv);
}
