#pragma once

#include <filesystem>
#include <functional>

namespace obscura {

// Processes that share the timing of one folder take turns on each machine, for two that are timed
// at once slow each other down. A turn ends with its object or its process; no file is left.
class TimingTurn {
  public:
    // Waits for it, calling `waiting` twice a second.
    TimingTurn(const std::filesystem::path& folder, const std::function<void()>& waiting);
    ~TimingTurn();
    TimingTurn(const TimingTurn&) = delete;
    TimingTurn& operator=(const TimingTurn&) = delete;

  private:
    int socket_;
};

} // namespace obscura
