#include "base/shipped.h"

#include "base/error.h"

namespace obscura {

namespace fs = std::filesystem;

fs::path shipped(std::string_view name) {
    const fs::path folder =
        fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/obscura";
    std::error_code missing;
    fs::path path = fs::canonical(folder / name, missing);
    if (missing)
        throw Error({(folder / name).string(), 0, 0, {}},
                    "expected this here, which comes with the program, found nothing; install "
                    "Obscura anew, all of it");
    return path;
}

} // namespace obscura
