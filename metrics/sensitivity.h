#pragma once

#include <array>
#include <vector>

namespace obscura {

// The contrast sensitivity of an eye to one frequency, by the luminance that it has adapted to: the
// inverse of the least contrast (Weber) that is seen, of the channels achromatic, red-green and
// yellow-violet.
class Sensitivity {
  public:
    // Beyond the table's 0.1 ... 64 cycles per degree it is as at their ends.
    explicit Sensitivity(double cyclesPerDegree);

    // At a luminance above 0, cd/m2; the table's 0.005 ... 10,000 bound it alike. Between two rows
    // of the table it is a power of luminance, to 0.1 % where it is steepest.
    std::array<float, 3> at(float luminance) const;

  private:
    std::vector<std::array<float, 3>> nodes_; // 128 an octave, evenly within it
};

} // namespace obscura
