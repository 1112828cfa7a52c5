#include "archive/zip.h"

#include "archive/paths.h"
#include "base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <vector>

namespace obscura {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& zip, const std::string& what) {
    throw Error({zip.string(), 0, 0, {}}, what);
}

[[noreturn]] void refuse(const fs::path& zip, std::string_view name, const std::string& what) {
    fail(zip, fmt::format("\"{:.100}\" {}; obscura-archive makes no such archive: get it anew from "
                          "where it came",
                          name, what));
}

std::string reasonOf(int code) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    return reason;
}

struct Discard { // without writing
    void operator()(zip_t* zip) const { zip_discard(zip); }
};
using Zip = std::unique_ptr<zip_t, Discard>;

Zip openZip(const fs::path& path, int how) {
    int code = 0;
    Zip zip(zip_open(path.c_str(), how, &code));
    if (!zip)
        fail(path, fmt::format("expected a zip file, whole and undamaged: {}",
                               code == ZIP_ER_EXISTS && (how & ZIP_RDONLY) ? "a name is there twice"
                                                                           : reasonOf(code)));
    return zip;
}

void addFile(zip_t* zip, const fs::path& path, const std::string& name, const NewFile& file) {
    zip_source_t* source = file.copyOf.empty()
                               ? zip_source_buffer(zip, file.text.data(), file.text.size(), 0)
                               : zip_source_file(zip, file.copyOf.c_str(), 0, -1);
    const zip_int64_t index =
        source ? zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    constexpr zip_uint16_t firstOf1980 = 1 << 5 | 1;
    constexpr zip_uint32_t regularFile = zip_uint32_t{0100644} << 16;
    const auto at = static_cast<zip_uint64_t>(index);
    if (index < 0 || zip_set_file_compression(zip, at, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(zip, at, 0, firstOf1980, 0) != 0 ||
        zip_file_set_external_attributes(zip, at, 0, ZIP_OPSYS_UNIX, regularFile) != 0) {
        const std::string reason = zip_strerror(zip);
        if (source && index < 0)
            zip_source_free(source);
        fail(path, fmt::format("\"{}\" cannot be added: {}", name, reason));
    }
}

// A file of somebody's zip, as it declares itself.
struct Entry {
    std::string path; // without a slash at its end
    zip_uint64_t index = 0, size = 0;
    bool isFolder = false;
};

class Unpacking {
  public:
    explicit Unpacking(const fs::path& path)
        : path_(path), zip_(openZip(path, ZIP_RDONLY | ZIP_CHECKCONS)) {
        const zip_int64_t count = zip_get_num_entries(zip_.get(), 0);
        for (zip_int64_t i = 0; i < count; ++i)
            entries_.push_back(look(static_cast<zip_uint64_t>(i)));
        checkNames();
    }

    // Bytes, so declared.
    zip_uint64_t size() const {
        zip_uint64_t sum = 0;
        for (const Entry& entry : entries_)
            sum += entry.size; // each is below the bound, so that the sum cannot run over
        return sum;
    }

    std::string folder() const {
        if (entries_.empty())
            fail(path_, "expected an archive, found an empty zip");
        const std::string first = entries_.front().path.substr(0, entries_.front().path.find('/'));
        for (const Entry& entry : entries_)
            if (entry.path != first && !entry.path.starts_with(first + "/"))
                refuse(path_, entry.path,
                       fmt::format("does not lie in the one folder \"{}\"", first));
        return first;
    }

    void unpack(const fs::path& into) const {
        for (const Entry& entry : entries_) {
            const fs::path target = into / entry.path;
            fs::create_directories(entry.isFolder ? target : target.parent_path());
            if (!entry.isFolder)
                unpack(entry, target);
        }
    }

  private:
    // Far more than tables are worth, and little for who wants to fill a disk.
    static constexpr zip_uint64_t mostTimes = 100;

    Entry look(zip_uint64_t index) const {
        zip_stat_t stat;
        const char* raw = zip_get_name(zip_.get(), index, ZIP_FL_ENC_STRICT);
        if (!raw || zip_stat_index(zip_.get(), index, 0, &stat) != 0)
            fail(path_, fmt::format("expected a name for each file, and a size: entry {}: {}",
                                    index + 1, zip_strerror(zip_.get())));
        std::string name = raw;
        Entry entry{name, index, stat.size, name.ends_with('/')};
        if (entry.isFolder)
            entry.path.pop_back();
        if (const std::string fault = faultOfPath(entry.path); !fault.empty())
            refuse(path_, name, "is no path within an archive: it " + fault);
        constexpr zip_uint64_t needed =
            ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
        if ((stat.valid & needed) != needed)
            refuse(path_, name, "does not say how large and how packed it is");
        if (stat.encryption_method != ZIP_EM_NONE)
            refuse(path_, name, "is encrypted");
        if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
            refuse(path_, name, "is compressed by another method than \"deflate\"");
        if (entry.size > mostTimes * fs::file_size(path_) || (entry.isFolder && entry.size > 0))
            refuse(path_, name, fmt::format("claims to have {} bytes", entry.size));
        checkKind(entry, name);
        return entry;
    }

    // A zip that was made on Unix says what each file is.
    void checkKind(const Entry& entry, const std::string& name) const {
        zip_uint8_t system = 0;
        zip_uint32_t attributes = 0;
        if (zip_file_get_external_attributes(zip_.get(), entry.index, 0, &system, &attributes) != 0)
            refuse(path_, name, "does not say what it is");
        const mode_t kind =
            system == ZIP_OPSYS_UNIX || system == ZIP_OPSYS_OS_X ? (attributes >> 16) & S_IFMT : 0;
        if (kind != 0 && kind != (entry.isFolder ? S_IFDIR : S_IFREG))
            refuse(path_, name, "is a link, a device or the like, and no file");
    }

    void checkNames() const {
        std::set<std::string> files, folders;
        for (const Entry& entry : entries_)
            if (!(entry.isFolder ? folders : files).insert(entry.path).second)
                refuse(path_, entry.path, "is there twice");
        for (const Entry& entry : entries_)
            for (std::size_t end = entry.path.size(); end != std::string::npos;
                 end = end > 0 ? entry.path.rfind('/', end - 1) : std::string::npos)
                if ((entry.isFolder || end < entry.path.size()) &&
                    files.contains(entry.path.substr(0, end)))
                    refuse(path_, entry.path.substr(0, end), "is both a file and a folder");
        if (size() > mostTimes * fs::file_size(path_))
            fail(path_, fmt::format("expected at most {} times as much as the zip is large, found "
                                    "files that claim {} bytes",
                                    mostTimes, size()));
    }

    void unpack(const Entry& entry, const fs::path& target) const {
        struct Close {
            void operator()(zip_file_t* file) const { zip_fclose(file); }
        };
        const std::unique_ptr<zip_file_t, Close> from(zip_fopen_index(zip_.get(), entry.index, 0));
        if (!from)
            refuse(path_, entry.path, fmt::format("is damaged: {}", zip_strerror(zip_.get())));
        const int to =
            ::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (to < 0)
            fail(target, fmt::format("cannot be written: {}", std::strerror(errno)));
        bool written = true;
        const std::string fault = copy(from.get(), entry.size, [&](std::span<const char> bytes) {
            written = written &&
                      ::write(to, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
        });
        const int reason = errno;
        ::close(to);
        if (!written)
            fail(target, fmt::format("cannot be written: {}", std::strerror(reason)));
        if (!fault.empty())
            refuse(path_, entry.path, fault);
    }

    // "" when all went well.
    template <typename Write>
    static std::string copy(zip_file_t* from, zip_uint64_t size, Write write) {
        std::array<char, 65536> buffer;
        zip_uint64_t had = 0;
        while (true) {
            const zip_int64_t count = zip_fread(from, buffer.data(), buffer.size());
            if (count < 0)
                return fmt::format("is damaged: {}", zip_file_strerror(from));
            if (count == 0)
                return had == size ? "" : fmt::format("has {} bytes, and claims {}", had, size);
            had += static_cast<zip_uint64_t>(count);
            if (had > size)
                return fmt::format("has more than the {} bytes that it claims", size);
            write(std::span<const char>(buffer).first(static_cast<std::size_t>(count)));
        }
    }

    fs::path path_;
    Zip zip_;
    std::vector<Entry> entries_;
};

} // namespace

void writeZip(const fs::path& path, const std::string& folder, const NewFiles& files) {
    Zip zip = openZip(path, ZIP_CREATE | ZIP_EXCL);
    for (const auto& [name, file] : files)
        addFile(zip.get(), path, folder + "/" + name, file);
    if (zip_close(zip.get()) != 0)
        fail(path, fmt::format("cannot be written: {}", zip_strerror(zip.get())));
    static_cast<void>(zip.release()); // closing has freed it
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const int failed = file < 0 || ::fsync(file);
    ::close(file);
    if (failed)
        fail(path, fmt::format("cannot be flushed to disk: {}", std::strerror(errno)));
}

fs::path unpackZip(const fs::path& zip, const fs::path& into) {
    const Unpacking unpacking(zip);
    const std::string folder = unpacking.folder();
    constexpr std::uintmax_t kept = 64 << 20; // bytes that stay free
    fs::create_directories(into);
    if (const std::uintmax_t room = fs::space(into).available;
        unpacking.size() > room || room - unpacking.size() < kept)
        fail(into, fmt::format("expected room for {} bytes, found {} free; set TMPDIR to a folder "
                               "with more",
                               unpacking.size(), room));
    unpacking.unpack(into);
    return into / folder;
}

} // namespace obscura
