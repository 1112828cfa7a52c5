#include "base/symbol.h"

#include "base/error.h"

#include <array>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace obscura {

namespace {

// Blocks never move, so that a symbol is read while others are made.
class Table {
  public:
    Table() { add(""); }

    std::uint32_t numberOf(std::string_view text) {
        const std::lock_guard lock(mutex_);
        const auto found = numbers_.find(text);
        return found != numbers_.end() ? found->second : add(text);
    }
    const std::string& operator[](std::uint32_t number) const {
        return blocks_[number / size][number % size];
    }

  private:
    static constexpr std::uint32_t size = 4096;

    std::uint32_t add(std::string_view text) {
        if (count_ == blocks_.size() * size)
            throw Error("too many different texts: the program keeps 67 million");
        auto& block = blocks_[count_ / size];
        if (!block)
            block = std::make_unique<std::string[]>(size);
        std::string& kept = block[count_ % size];
        kept = text;
        numbers_.emplace(kept, count_);
        return count_++;
    }

    std::mutex mutex_;
    std::array<std::unique_ptr<std::string[]>, 16384> blocks_;
    std::unordered_map<std::string_view, std::uint32_t> numbers_;
    std::uint32_t count_ = 0;
};

Table& table() {
    static Table table;
    return table;
}

} // namespace

Symbol::Symbol(std::string_view text) : number_(table().numberOf(text)) {}

Symbol Symbol::numbered(std::uint32_t number) {
    Symbol symbol;
    symbol.number_ = number;
    return symbol;
}

const std::string& Symbol::text() const { return table()[number_]; }

} // namespace obscura
