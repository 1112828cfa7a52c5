#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace obscura {

// A text that stands in many places, kept once for the whole program, in four bytes: equal texts
// are equal symbols. From any thread.
class Symbol {
  public:
    Symbol() = default; // ""
    explicit Symbol(std::string_view text);

    const std::string& text() const;
    operator const std::string&() const { return text(); }
    std::uint32_t number() const { return number_; } // from 0 for "", in the order of making

    bool operator==(const Symbol&) const = default;

  private:
    std::uint32_t number_ = 0;
};

inline const std::string& format_as(Symbol symbol) { return symbol.text(); }

} // namespace obscura
