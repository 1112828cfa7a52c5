#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace obscura::builtin {

// A scaly body swept along a smooth curve, with ribs below and a crest along its back; a horned
// head with open jaws. A field as in implicit.h.
class Serpent {
  public:
    struct Joint {
        glm::vec3 position;
        float radius;
    };
    // From the tail's tip to the head, which looks the way the body ends.
    explicit Serpent(const std::vector<Joint>& joints);

    float distance(glm::vec3 p) const;

  private:
    // A point of the curve. `along` counts in radii, so that scales shrink with the body.
    struct Ring {
        glm::vec3 centre, back; // back: the unit direction to the crest
        float radius, along;
    };
    // A run of the curve and the ball that holds it, to pass over runs that are far away.
    struct Run {
        std::size_t first, last;
        glm::vec3 centre;
        float radius, least; // of the ball; of the body at its centre
    };
    struct Nearest {
        float distance = 1e9F; // to the body without its skin
        std::size_t ring = 0;
        float t = 0; // from that ring towards the next
    };
    Nearest nearest(glm::vec3 p) const;
    void turnBacks();
    void groupRuns();
    float head(glm::vec3 p) const;

    std::vector<Ring> rings_;
    std::vector<Run> runs_;
    glm::mat3 headFromWorld_{1};
};

} // namespace obscura::builtin
