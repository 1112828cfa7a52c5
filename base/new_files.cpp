#include "base/new_files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"

#include <fmt/format.h>

#include <system_error>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// A hidden folder of this process's own, with all that is in it.
class Unfinished {
  public:
    explicit Unfinished(const fs::path& beside)
        : path_(beside / fmt::format(".obscura-unfinished-new.{}", ProcessId::current().text())) {
        if (!fs::create_directory(path_))
            throw Error({path_.string(), 0, 0, {}}, "expected nothing of this name; remove it");
    }
    ~Unfinished() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

} // namespace

void checkIsFree(const fs::path& path) {
    const fs::file_status status = fs::symlink_status(path);
    if (fs::exists(status) && !(fs::is_directory(status) && fs::is_empty(path)))
        throw Error({path.string(), 0, 0, {}},
                    "expected the name of something new, or an empty folder, found something "
                    "there, which is not replaced; give another name");
}

void makeNew(const fs::path& path, const std::function<void(const fs::path&)>& make) {
    checkIsFree(path);
    const fs::path target = fs::weakly_canonical(path); // a trailing slash has no name
    makeFolders(target.parent_path());
    const Unfinished unfinished(target.parent_path());
    const fs::path made = unfinished.path() / target.filename();
    make(made);
    // A hard link, unlike a rename, is never made over a file; a folder never takes the place of
    // one that has something in it.
    std::error_code failed;
    if (fs::is_directory(made))
        fs::rename(made, target, failed);
    else
        fs::create_hard_link(made, target, failed);
    if (failed)
        throw Error({path.string(), 0, 0, {}}, fmt::format("cannot be made: {}", failed.message()));
}

void writeFiles(const fs::path& folder, const NewFiles& files) {
    for (const auto& [path, file] : files)
        writeFile(folder / path, file.copyOf.empty() ? file.text : readFile(file.copyOf));
}

} // namespace obscura
