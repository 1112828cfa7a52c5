#include "protocols/reader/manifest.h"

#include "base/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace obscura {

namespace {

using nlohmann::json;

// 3 had no display, qualities and times, 2 pairs, 1 one contact sheet and no hash of the code.
constexpr int newestVersion = 4;

// Writing ------------------------------------------------------------------------------------

json toJson(const Camera& camera) {
    return {{"position", camera.position},
            {"target", camera.target},
            {"up", camera.up},
            {"fovDegrees", camera.fovDegrees},
            {"near", camera.near}};
}

json toJson(const View& view) {
    json result = {{"name", view.name},
                   {"camera", toJson(view.camera)},
                   {"radius", view.radius},
                   {"exposure", view.exposure}};
    result[view.file.empty() ? "builtin" : "file"] = view.file.empty() ? view.builtin : view.file;
    if (view.ground)
        result["ground"] = {{"wall", view.ground->wall}, {"colour", view.ground->colour}};
    return result;
}

json toJson(const Level& level) {
    json result = {{"name", level.name},
                   {"curve", curveNames()[static_cast<std::size_t>(level.curve)]},
                   {"white", level.white},
                   {"occludeDirect", level.occludeDirect}};
    if (level.ambient) {
        result["ambient"] = *level.ambient;
        result["background"] = level.background;
    }
    if (level.sky)
        result["sky"] = {{"zenith", level.sky->zenith},
                         {"horizon", level.sky->horizon},
                         {"ground", level.sky->ground}};
    if (!level.environment.empty())
        result["environment"] = level.environment;
    if (level.sun)
        result["sun"] = {{"azimuthDegrees", level.sun->azimuthDegrees},
                         {"elevationDegrees", level.sun->elevationDegrees},
                         {"irradiance", level.sun->irradiance}};
    if (level.sceneLights) // recipes without stay the same
        result["sceneLights"] = true;
    return result;
}

json toJson(const Recipe& recipe) {
    return {{"width", recipe.width},
            {"height", recipe.height},
            {"antialiasing", recipe.antialiasing},
            {"seed", recipe.seed},
            {"view", toJson(recipe.view)},
            {"sceneSha256", recipe.sceneSha256},
            {"level", toJson(recipe.level)},
            {"environmentSha256", recipe.environmentSha256},
            {"normals", normalsNames()[static_cast<std::size_t>(recipe.normals)]},
            {"technique", recipe.technique},
            {"settings", recipe.settings},
            {"shaderSha256", recipe.shaderSha256},
            {"codeSha256", recipe.codeSha256},
            {"programVersion", recipe.programVersion},
            {"gl",
             {{"vendor", recipe.glVendor},
              {"renderer", recipe.glRenderer},
              {"version", recipe.glVersion}}}};
}

json toJson(const FileRecord& file) { return {{"path", file.path}, {"sha256", file.sha256}}; }

json toJson(const Derivation& derived) {
    return {{"fromSha256", derived.fromSha256},
            {"reference", derived.reference},
            {"referenceSha256", derived.referenceSha256},
            {"amplify", derived.amplify},
            {"magnify", derived.magnify},
            {"crop", derived.crop}};
}

json toJson(const ImageRecord& image) {
    json layers = json::object();
    for (const auto& [kind, file] : image.layers)
        layers[kind] = toJson(file);
    json result = {{"name", image.name},
                   {"recipe", toJson(image.recipe)},
                   {"recipeSha256", image.recipe.sha256()},
                   {"inputsSha256", image.inputsSha256},
                   {"meanOcclusion", image.meanOcclusion},
                   {"image", toJson(image.image)},
                   {"layers", layers}};
    if (image.derived)
        result["derived"] = toJson(*image.derived);
    if (image.quality)
        result["quality"] = {{"rmse", image.quality->rmse},
                             {"jod", image.quality->jod},
                             {"referenceSha256", image.quality->referenceSha256}};
    if (image.milliseconds)
        result["milliseconds"] = *image.milliseconds;
    return result;
}

// The keys of [display].
json toJson(const Display& display) {
    json result = {{"width", display.width},
                   {"height", display.height},
                   {"diagonalInches", display.diagonalInches},
                   {"distanceCm", display.distance * 100},
                   {"peak", display.peak},
                   {"contrast", display.contrast},
                   {"ambientLux", display.ambient}};
    if (!display.name.empty())
        result["name"] = display.name;
    return result;
}

json toJson(const TimingRecord& timing) {
    return {{"method", timing.method},
            {"renderer", timing.renderer},
            {"processor", timing.processor},
            {"starcraft", timing.starcraft}};
}

// Reading ------------------------------------------------------------------------------------

// A JSON object with its path in the file, for errors.
class Node {
  public:
    Node(const json& value, std::string file, std::string path)
        : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

    Node operator[](const std::string& key) const {
        const std::string path = path_.empty() ? key : path_ + "." + key;
        if (!value_->is_object() || !value_->contains(key))
            throw Error({file_, 0, 0, path}, "expected this key, found nothing; generate the "
                                             "stimuli again with obscura-stimuli");
        return {(*value_)[key], file_, path};
    }
    bool has(const std::string& key) const { return value_->contains(key); }

    template <typename T>
    void read(T& target) const {
        if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
            if (!holdsWhole<T>())
                throw Error({file_, 0, 0, path_},
                            fmt::format("expected a whole number, at most {}, found {}",
                                        std::numeric_limits<T>::max(), value_->dump()));
        try {
            value_->get_to(target);
        } catch (const json::exception& error) {
            throw Error({file_, 0, 0, path_},
                        fmt::format("expected another type of value: {}", error.what()));
        }
    }
    template <typename T>
    T as() const {
        T result{};
        read(result);
        return result;
    }
    // The place of a word in a list of those that are known.
    std::size_t choice(const std::vector<std::string>& words) const {
        const auto word = as<std::string>();
        const auto found = std::find(words.begin(), words.end(), word);
        if (found == words.end())
            throw Error({file_, 0, 0, path_},
                        fmt::format("expected one of {}, found \"{}\"; another version of the "
                                    "program may have made the file",
                                    fmt::join(words, ", "), word));
        return static_cast<std::size_t>(found - words.begin());
    }
    std::vector<Node> items() const {
        if (!value_->is_array())
            throw Error({file_, 0, 0, path_}, "expected a list, found something else");
        std::vector<Node> result;
        for (std::size_t i = 0; i < value_->size(); ++i)
            result.emplace_back((*value_)[i], file_, fmt::format("{}[{}]", path_, i + 1));
        return result;
    }
    std::vector<std::pair<std::string, Node>> entries() const {
        if (!value_->is_object())
            throw Error({file_, 0, 0, path_}, "expected an object, found something else");
        std::vector<std::pair<std::string, Node>> result;
        for (const auto& [key, value] : value_->items())
            result.emplace_back(key, Node(value, file_, path_ + "." + key));
        return result;
    }

  private:
    // json would cut a number to fit.
    template <typename T>
    bool holdsWhole() const {
        return value_->is_number_unsigned()
                   ? std::in_range<T>(value_->get<std::uint64_t>())
                   : value_->is_number_integer() && std::in_range<T>(value_->get<std::int64_t>());
    }

    const json* value_;
    std::string file_, path_;
};

Camera readCamera(const Node& node) {
    Camera camera;
    node["position"].read(camera.position);
    node["target"].read(camera.target);
    node["up"].read(camera.up);
    node["fovDegrees"].read(camera.fovDegrees);
    node["near"].read(camera.near);
    return camera;
}

View readView(const Node& node) {
    View view;
    node["name"].read(view.name);
    node.has("file") ? node["file"].read(view.file) : node["builtin"].read(view.builtin);
    view.camera = readCamera(node["camera"]);
    node["radius"].read(view.radius);
    node["exposure"].read(view.exposure);
    if (node.has("ground"))
        view.ground =
            Ground{node["ground"]["wall"].as<double>(), node["ground"]["colour"].as<Vec3>()};
    return view;
}

Level readLevel(const Node& node) {
    Level level;
    node["name"].read(level.name);
    level.curve = static_cast<Curve>(node["curve"].choice(curveNames()));
    node["white"].read(level.white);
    node["occludeDirect"].read(level.occludeDirect);
    if (node.has("ambient")) {
        level.ambient = node["ambient"].as<Vec3>();
        node["background"].read(level.background);
    }
    if (node.has("sky"))
        level.sky = Sky{node["sky"]["zenith"].as<Vec3>(), node["sky"]["horizon"].as<Vec3>(),
                        node["sky"]["ground"].as<Vec3>()};
    if (node.has("environment"))
        node["environment"].read(level.environment);
    if (node.has("sun"))
        level.sun =
            Sun{node["sun"]["azimuthDegrees"].as<double>(),
                node["sun"]["elevationDegrees"].as<double>(), node["sun"]["irradiance"].as<Vec3>()};
    if (node.has("sceneLights"))
        node["sceneLights"].read(level.sceneLights);
    return level;
}

Normals readNormals(const Node& node) {
    const std::string name = node.as<std::string>();
    return name == "face" ? Normals::face : name == "mapped" ? Normals::mapped : Normals::smooth;
}

Recipe readRecipe(const Node& node) {
    Recipe recipe;
    node["width"].read(recipe.width);
    node["height"].read(recipe.height);
    node["antialiasing"].read(recipe.antialiasing);
    node["seed"].read(recipe.seed);
    recipe.view = readView(node["view"]);
    node["sceneSha256"].read(recipe.sceneSha256);
    recipe.level = readLevel(node["level"]);
    node["environmentSha256"].read(recipe.environmentSha256);
    recipe.normals = readNormals(node["normals"]);
    node["technique"].read(recipe.technique);
    node["settings"].read(recipe.settings);
    node["shaderSha256"].read(recipe.shaderSha256);
    if (node.has("codeSha256"))
        node["codeSha256"].read(recipe.codeSha256);
    node["programVersion"].read(recipe.programVersion);
    node["gl"]["vendor"].read(recipe.glVendor);
    node["gl"]["renderer"].read(recipe.glRenderer);
    node["gl"]["version"].read(recipe.glVersion);
    return recipe;
}

FileRecord readFileRecord(const Node& node) {
    return {node["path"].as<std::string>(), node["sha256"].as<std::string>()};
}

Derivation readDerivation(const Node& node) {
    Derivation derived;
    node["fromSha256"].read(derived.fromSha256);
    node["reference"].read(derived.reference);
    node["referenceSha256"].read(derived.referenceSha256);
    node["amplify"].read(derived.amplify);
    node["magnify"].read(derived.magnify);
    node["crop"].read(derived.crop);
    return derived;
}

Display readDisplay(const Node& node) {
    Display display;
    if (node.has("name"))
        node["name"].read(display.name);
    node["width"].read(display.width);
    node["height"].read(display.height);
    node["diagonalInches"].read(display.diagonalInches);
    display.distance = node["distanceCm"].as<double>() / 100;
    node["peak"].read(display.peak);
    node["contrast"].read(display.contrast);
    node["ambientLux"].read(display.ambient);
    return display;
}

TimingRecord readTiming(const Node& node) {
    TimingRecord timing;
    node["method"].read(timing.method);
    node["renderer"].read(timing.renderer);
    node["processor"].read(timing.processor);
    node["starcraft"].read(timing.starcraft);
    return timing;
}

ImageRecord readImageRecord(const Node& node) {
    ImageRecord image;
    node["name"].read(image.name);
    image.recipe = readRecipe(node["recipe"]);
    node["inputsSha256"].read(image.inputsSha256);
    node["meanOcclusion"].read(image.meanOcclusion);
    image.image = readFileRecord(node["image"]);
    for (const auto& [kind, file] : node["layers"].entries())
        image.layers[kind] = readFileRecord(file);
    if (node.has("derived")) {
        image.derived = readDerivation(node["derived"]);
        image.layers["rendered"] = readFileRecord(node["layers"]["rendered"]); // must be there
    }
    if (node.has("quality"))
        image.quality = {node["quality"]["rmse"].as<double>(), node["quality"]["jod"].as<double>(),
                         node["quality"]["referenceSha256"].as<std::string>()};
    if (node.has("milliseconds"))
        image.milliseconds = node["milliseconds"].as<double>();
    return image;
}

ConditionRecord readCondition(const Node& node) {
    ConditionRecord condition;
    node["condition"].read(condition.condition);
    node["level"].read(condition.level);
    node["view"].read(condition.view);
    node["hypothesis"].read(condition.hypothesis);
    node["radius"].read(condition.radius);
    const auto add = [&](const std::string& role, const Node& image) {
        condition.images.push_back(readImageRecord(image));
        condition.images.back().role = role;
    };
    if (node.has("images"))
        for (const auto& [role, image] : node["images"].entries())
            add(role, image);
    else // versions 1 and 2 had two
        for (const char* role : {"a", "b"})
            add(role, node[role]);
    return condition;
}

} // namespace

const ImageRecord* ConditionRecord::find(std::string_view role) const {
    const auto found = std::find_if(images.begin(), images.end(),
                                    [&](const ImageRecord& image) { return image.role == role; });
    return found == images.end() ? nullptr : &*found;
}

const ImageRecord& ConditionRecord::image(std::string_view role) const {
    if (const ImageRecord* found = find(role))
        return *found;
    throw Error(fmt::format("condition \"{}\" has no image \"{}\"", condition, role));
}

ImageRecord& ConditionRecord::image(std::string_view role) {
    if (!find(role))
        images.emplace_back().role = role;
    return const_cast<ImageRecord&>(*find(role));
}

std::string Recipe::json() const { return toJson(*this).dump(); }
std::string Recipe::sha256() const { return obscura::sha256(json()); }

std::vector<std::string> differences(const Recipe& recorded, const Recipe& now) {
    const json before = toJson(recorded).flatten(), after = toJson(now).flatten();
    std::set<std::string> keys;
    for (const json& each : {before, after})
        for (const auto& [key, value] : each.items())
            keys.insert(key);
    const auto spelt = [](const json& value) {
        return value.is_null()     ? "none"
               : value.is_number() ? fmt::format("{:g}", value.get<double>())
                                   : value.dump();
    };
    std::vector<std::string> result;
    for (const std::string& key : keys) {
        const json was = before.value(key, json()), is = after.value(key, json());
        if (was == is)
            continue;
        std::string name = key.substr(1); // a JSON pointer: "/settings/radius"
        std::replace(name.begin(), name.end(), '/', '.');
        const bool alike = spelt(was) == spelt(is); // they differ in a digit that is not printed
        result.push_back(fmt::format("{}: {}, now {}", name, alike ? was.dump() : spelt(was),
                                     alike ? is.dump() : spelt(is)));
    }
    return result;
}

Manifest readManifest(const std::filesystem::path& path) {
    return parseManifest(readFile(path), path);
}

Manifest parseManifest(const std::string& text, const std::filesystem::path& path) {
    const std::string file = path.string();
    json value;
    try {
        value = json::parse(text);
    } catch (const json::exception& error) {
        throw Error({file, 0, 0, {}}, fmt::format("expected JSON: {}", error.what()));
    }
    const Node root(value, file, "");
    Manifest manifest;
    root["schemaVersion"].read(manifest.schemaVersion);
    if (manifest.schemaVersion < 1 || manifest.schemaVersion > newestVersion)
        throw Error({file, 0, 0, "schemaVersion"},
                    fmt::format("expected 1 ... {}, found {}; generate the stimuli again with "
                                "obscura-stimuli",
                                newestVersion, manifest.schemaVersion));
    root["study"].read(manifest.study);
    root["title"].read(manifest.title);
    root["protocolSha256"].read(manifest.protocolSha256);
    if (root.has("stimuliSha256"))
        root["stimuliSha256"].read(manifest.stimuliSha256);
    root["commit"].read(manifest.commit);
    root["width"].read(manifest.width);
    root["height"].read(manifest.height);
    for (const Node& condition : root[manifest.schemaVersion < 3 ? "pairs" : "conditions"].items())
        manifest.conditions.push_back(readCondition(condition));
    if (root.has("contactSheets"))
        for (const Node& sheet : root["contactSheets"].items())
            manifest.contactSheets.push_back(readFileRecord(sheet));
    else // version 1 had one
        manifest.contactSheets.push_back(readFileRecord(root["contactSheet"]));
    if (root.has("display"))
        manifest.display = readDisplay(root["display"]);
    if (root.has("timing"))
        manifest.timing = readTiming(root["timing"]);
    manifest.folder = path.parent_path();
    return manifest;
}

std::string manifestText(const Manifest& manifest) {
    json conditions = json::array();
    for (const ConditionRecord& condition : manifest.conditions) {
        json images = json::object();
        for (const ImageRecord& image : condition.images)
            images[image.role] = toJson(image);
        conditions.push_back({{"condition", condition.condition},
                              {"level", condition.level},
                              {"view", condition.view},
                              {"hypothesis", condition.hypothesis},
                              {"radius", condition.radius},
                              {"images", images}});
    }
    json sheets = json::array();
    for (const FileRecord& sheet : manifest.contactSheets)
        sheets.push_back(toJson(sheet));
    json root = {{"schemaVersion", newestVersion},
                 {"study", manifest.study},
                 {"title", manifest.title},
                 {"protocolSha256", manifest.protocolSha256},
                 {"stimuliSha256", manifest.stimuliSha256},
                 {"commit", manifest.commit},
                 {"width", manifest.width},
                 {"height", manifest.height},
                 {"conditions", conditions},
                 {"contactSheets", sheets}};
    if (manifest.display)
        root["display"] = toJson(*manifest.display);
    if (manifest.timing)
        root["timing"] = toJson(*manifest.timing);
    return root.dump(2) + "\n";
}

void writeManifest(const std::filesystem::path& path, const Manifest& manifest) {
    writeFile(path, manifestText(manifest));
}

} // namespace obscura
