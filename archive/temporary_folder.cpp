#include "archive/temporary_folder.h"

#include "base/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace obscura {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "obscura-archive-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw Error({name, 0, 0, {}}, std::string("expected a place for a temporary folder: ") +
                                          std::strerror(errno) +
                                          "; set TMPDIR to one that can be written");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace obscura
