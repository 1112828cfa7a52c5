#include "bench/sweep/results.h"

#include "base/error.h"
#include "bench/sweep/fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace obscura {

using nlohmann::ordered_json;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <typename Read>
auto parsed(const std::string& text, Read read) {
    try {
        return read(ordered_json::parse(text));
    } catch (const nlohmann::json::exception& error) {
        throw Error(fmt::format("expected what a unit of a sweep leaves, found {:.60}: {}; name "
                                "another folder with --out",
                                text, error.what()));
    }
}

// What a visitor of fields puts into `object`, or takes from it.
auto writer(ordered_json& object) {
    return [&object](const std::string& name, const auto& value) { object[name] = value; };
}
auto reader(const ordered_json& object) {
    return [&object](const std::string& name, auto& value) {
        const ordered_json& from = object.at(name);
        if constexpr (std::is_same_v<decltype(value), double&>)
            value = from.is_null() ? nan : from.template get<double>();
        else
            from.get_to(value);
    };
}

template <typename Fields>
ordered_json objectOf(const Fields& fields) {
    ordered_json object;
    eachField(fields, writer(object));
    return object;
}

template <typename Fields>
Fields fieldsIn(const ordered_json& object) {
    Fields fields;
    eachField(fields, reader(object));
    return fields;
}

} // namespace

std::string fitResult(const Fitted& fitted) { return ordered_json{{"fitted", fitted}}.dump(); }

Fitted fitIn(const std::string& result) {
    return parsed(result, [](const ordered_json& root) { return root.at("fitted").get<Fitted>(); });
}

std::string errorsResult(const ErrorsResult& errors) {
    ordered_json root{{"renderer", errors.renderer}, {"thumbnail", errors.errors.thumbnail}};
    auto write = writer(root);
    eachError(errors.errors, write);
    return root.dump();
}

ErrorsResult errorsIn(const std::string& result) {
    return parsed(result, [](const ordered_json& root) {
        ErrorsResult errors;
        auto read = reader(root);
        eachError(errors.errors, read);
        root.at("thumbnail").get_to(errors.errors.thumbnail);
        root.at("renderer").get_to(errors.renderer);
        return errors;
    });
}

std::string timesResult(const TimesResult& times) {
    auto rows = ordered_json::array(), growth = ordered_json::array();
    for (const SweepTimes& row : times.rows) {
        auto write = writer(rows.emplace_back());
        eachTime(row, write);
    }
    for (const GrowthRow& row : times.growth)
        growth.push_back(objectOf(row));
    return ordered_json{{"machine", objectOf(times.machine)}, {"rows", rows}, {"growth", growth}}
        .dump();
}

TimesResult timesIn(const std::string& result) {
    return parsed(result, [](const ordered_json& root) {
        TimesResult times{fieldsIn<TimedOn>(root.at("machine")), {}, {}};
        for (const ordered_json& row : root.at("rows")) {
            auto read = reader(row);
            eachTime(times.rows.emplace_back(), read);
        }
        for (const ordered_json& row : root.at("growth"))
            times.growth.push_back(fieldsIn<GrowthRow>(row));
        return times;
    });
}

} // namespace obscura
