#pragma once

#include <fmt/core.h>

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
    static Symbol numbered(std::uint32_t number);    // that has been made

    bool operator==(const Symbol&) const = default;

  private:
    std::uint32_t number_ = 0;
};

} // namespace obscura

template <>
struct fmt::formatter<obscura::Symbol> : fmt::formatter<std::string_view> {
    template <typename Context>
    auto format(obscura::Symbol symbol, Context& context) const {
        return fmt::formatter<std::string_view>::format(symbol.text(), context);
    }
};
