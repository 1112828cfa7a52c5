#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace obscura {

class TomlTable;

// What participants press, as a study may choose it: [keys]. Numbers are those of gl/input.h: keys
// by their place on a keyboard of the United States, and a gamepad's buttons.
struct Keys {
    std::vector<int> first, second; // of two options
    std::vector<int> go;            // ends a page or an image

    Keys();
    bool isGo(int key) const;
    int optionOf(int key) const; // 1 or 2; 0 for other keys
    bool operator==(const Keys&) const = default;
};

// What stands on a key, and in a page's key cap: "F", "←"; that of a gamepad in a circle.
std::string capOf(int key);
std::string_view nameOfKey(int key); // as protocols spell it

// Throws Error for names that are no key, one key for two things, and keys that pages need.
Keys parseKeys(TomlTable table);

} // namespace obscura
