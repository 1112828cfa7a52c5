#pragma once

#include <filesystem>
#include <memory>

namespace obscura::test {

// A file manager's side of drag and drop (XDND, version 5): a window of its own that offers one
// file to the window under a place of the screen. Whoever drives it calls serve() while the window
// runs.
class FileDrag {
  public:
    // Drags the file there and lets it go.
    FileDrag(const std::filesystem::path& file, int x, int y);
    ~FileDrag();

    // Answers what the other window has asked meanwhile; true once that says it has taken the file.
    bool serve();

  private:
    struct Sender;
    std::unique_ptr<Sender> sender_;
};

} // namespace obscura::test
