#include "analysis/export/pseudonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string_view>

namespace obscura {

namespace {

std::string randomName(std::random_device& device) {
    constexpr std::string_view signs = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"; // 32; no I, O, 0, 1
    std::string name;
    while (name.size() < 8)
        name += signs[device() % signs.size()];
    return name;
}

template <typename Key>
void rename(Key& key, const std::string& name, const Place& place) {
    const std::string begin = key.participantId + "-";
    if (!key.rowId.starts_with(begin))
        throw Error({place.file, place.line, 0, "row_id"},
                    fmt::format("expected a name that begins with \"{}\", which is then replaced, "
                                "found \"{}\"",
                                begin, key.rowId));
    key.rowId = name + "-" + key.rowId.substr(begin.size());
    key.participantId = name;
}

} // namespace

std::string renameParticipants(RecordedStudy& data) {
    std::random_device device;
    std::map<std::string, std::string> names;
    std::set<std::string> taken;
    for (SessionData& session : data.sessions) {
        std::string& name = names[session.participant];
        while (name.empty())
            if (const std::string drawn = randomName(device); taken.insert(drawn).second)
                name = drawn;
        for (auto& [row, place] : session.rows)
            rename(row, name, place);
        for (auto& [row, place] : session.phases)
            rename(row.trial, name, place);
        for (auto& [row, place] : session.answers)
            rename(row.trial, name, place);
        session.participant = name;
    }
    std::stable_sort(data.sessions.begin(), data.sessions.end(),
                     [](const auto& x, const auto& y) { return x.participant < y.participant; });
    std::string key = "participant_id,exported_as\n";
    for (const auto& [participant, name] : names)
        key += fmt::format("{},{}\n", participant, name);
    return key;
}

} // namespace obscura
