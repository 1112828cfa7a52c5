#pragma once

#include "protocols/reader/protocol.h"
#include "renderer/techniques/technique.h"

#include <map>
#include <string>
#include <vector>

namespace obscura {

// One value per parameter of a technique, in the table's order, each inside its range.
class Settings {
  public:
    // All defaults.
    explicit Settings(const Technique& technique);

    const Technique& technique() const { return *technique_; }
    bool has(std::string_view name) const;
    float operator[](std::string_view name) const; // asserts that the name exists
    // An unknown name, a value out of range, or a fraction where the unit is whole: an Error at
    // `place`.
    void set(std::string_view name, double value, const Place& place = {});
    // Sets all that the technique's preset of that name says. An unknown name is an Error at
    // `place`.
    void apply(std::string_view preset, const Place& place = {});

    const std::vector<float>& values() const { return values_; }
    std::map<std::string, double> named() const;

  private:
    std::size_t index(std::string_view name) const; // parameters.size() when there is none

    const Technique* technique_;
    std::vector<float> values_;
};

// The technique and settings that a protocol names: its preset, then the scene's `radius` (metres),
// then what it sets itself.
Settings settingsOf(const TechniqueSetting& setting, double radius);

} // namespace obscura
