#include "archive/versions.h"

#include "base/files.h"
#include "base/version.h"
#include "matching/anchor.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>

#include <algorithm>
#include <set>
#include <vector>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

std::string systemName() {
    utsname names{};
    ::uname(&names);
    return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

// "fmt 9.1.0, Embree 3.13.5, ..." as CMake found them.
ordered_json libraries() {
    ordered_json list = ordered_json::array();
    std::string_view rest = OBSCURA_LIBRARIES;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(", "), rest.size());
        list.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 2, rest.size()));
    }
    return list;
}

// Each once, in an order that does not depend on anything else.
ordered_json distinct(const std::vector<ordered_json>& all) {
    std::set<std::string> seen;
    for (const ordered_json& one : all)
        seen.insert(one.dump());
    ordered_json list = ordered_json::array();
    for (const std::string& one : seen)
        list.push_back(ordered_json::parse(one));
    return list;
}

ordered_json stimuliOf(const Manifest& manifest) {
    std::vector<ordered_json> all;
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images) {
            const Recipe& recipe = image.recipe;
            all.push_back({{"version", recipe.programVersion},
                           {"codeSha256", recipe.codeSha256},
                           {"gl",
                            {{"vendor", recipe.glVendor},
                             {"renderer", recipe.glRenderer},
                             {"version", recipe.glVersion}}}});
        }
    return {{"commit", manifest.commit},
            {"processor", manifest.timing ? manifest.timing->processor : ""},
            {"rendered", distinct(all)}};
}

// Of every session file, what names program and machine. One that is damaged names nothing.
ordered_json presentersOf(const fs::path& data) {
    std::vector<ordered_json> all;
    if (fs::is_directory(data / "sessions"))
        for (const fs::directory_entry& entry : fs::directory_iterator(data / "sessions")) {
            if (!entry.path().filename().string().ends_with("_session.json"))
                continue;
            const auto session = ordered_json::parse(readFile(entry.path()), nullptr, false);
            ordered_json one = ordered_json::object();
            for (const char* key : {"app_version", "git_commit", "machine", "system", "simulated"})
                if (session.is_object() && session.contains(key))
                    one[key] = session[key];
            if (!one.empty())
                all.push_back(std::move(one));
        }
    return distinct(all);
}

} // namespace

ordered_json thisMachine() {
    return {{"version", version()},
            {"commit", commit()},
            {"libraries", libraries()},
            {"system", systemName()},
            {"processor", processorName()}};
}

ordered_json versionsOf(const Manifest& manifest, const fs::path& data) {
    return {{"archive", thisMachine()},
            {"stimuli", stimuliOf(manifest)},
            {"presenter", presentersOf(data)}};
}

} // namespace obscura
