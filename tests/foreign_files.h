#pragma once

#include "base/files.h"
#include "base/process.h"

#include <filesystem>
#include <map>
#include <string>

namespace obscura::test {

// What writeFile() of a process that was killed leaves in a folder.
inline std::filesystem::path abandonedFile(const std::filesystem::path& folder) {
    ProcessId gone = ProcessId::current();
    --gone.start; // another that had this number
    std::filesystem::path path = folder / (".obscura-unfinished." + gone.text() + ".1");
    writeFile(path, "what a killed run leaves");
    return path;
}

// A folder with what is nobody's but the user's: hidden files, unknown folders, links.
class ForeignFiles {
  public:
    explicit ForeignFiles(const std::filesystem::path& folder) : folder_(folder) {
        namespace fs = std::filesystem;
        for (const char* name : {".gitignore",
                                 ".env",
                                 ".clang-tidy",
                                 ".first_a_crytek.123.png",
                                 ".1",
                                 ".a.2.png",
                                 ".obscura-unfinished",
                                 ".obscura-unfinished.1.2.x.y.1",
                                 "notes.txt",
                                 "frames/1.png",
                                 "finished/.hidden",
                                 "finished/notes.txt",
                                 "failures/mine.png",
                                 "flicker/1.png",
                                 "match/.keep",
                                 "thumbnails/.keep",
                                 "figures/mine.svg",
                                 "pictures/.keep",
                                 ".git/HEAD",
                                 ".hidden/.deeper/file"})
            write(name);
        write("elsewhere/target.txt");
        link("elsewhere/target.txt", ".link");
        link("elsewhere", "linked-folder");
        link("nowhere", ".dangling");
        ProcessId other = ProcessId::current();
        other.machine += "-b"; // may be writing at this moment
        write(".obscura-unfinished." + other.text() + ".7");
        fs::create_directories(folder_ / ".empty");
    }

    // The names of what is not as it was, "" when all survived.
    std::string lost() const {
        namespace fs = std::filesystem;
        std::string names;
        for (const auto& [name, content] : files_)
            if (!fs::is_regular_file(fs::symlink_status(folder_ / name)) ||
                readFile(folder_ / name) != content)
                names += name + "\n";
        for (const auto& [name, target] : links_)
            if (!fs::is_symlink(fs::symlink_status(folder_ / name)) ||
                fs::read_symlink(folder_ / name) != target)
                names += name + "\n";
        return names + (fs::is_directory(folder_ / ".empty") ? "" : ".empty\n");
    }

  private:
    void write(const std::string& name) {
        files_[name] = "of the user: " + name;
        writeFile(folder_ / name, files_[name]);
    }
    void link(const std::string& target, const std::string& name) {
        links_[name] = target;
        std::filesystem::create_symlink(target, folder_ / name);
    }

    std::filesystem::path folder_;
    std::map<std::string, std::string> files_, links_;
};

} // namespace obscura::test
