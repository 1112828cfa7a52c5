#pragma once

#include <ostream>
#include <string>

namespace obscura {

struct Mistake {
    const char* name;
    std::string from, to; // what is changed in the correct study of protocol_test.cpp
    std::string message;  // the whole error
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

// One mistake each. The messages were read by a person before they were put here.
inline const Mistake mistakes[] = {
    {"NotToml", "seed = 7", "seed = = 7",
     "small.toml:2:8: expected TOML: Error while parsing value: could not determine value type"},
    {"UnclosedText", "name = \"small\"", "name = \"small",
     "small.toml:1:14: expected TOML: Error while parsing string: unescaped control characters "
     "other than TAB (U+0009) are explicitly prohibited"},
    {"KeyTwice", "seed = 7", "seed = 7\nseed = 8",
     "small.toml:3:8: expected TOML: Error while parsing key-value pair: cannot redefine existing "
     "integer 'seed'"},
    {"NameMissing", "name = \"small\"\n", "",
     "small.toml:1:1: name: expected a text in quotes, found nothing; add \"name\" here"},
    {"NameHasCapitals", "name = \"small\"", "name = \"Small Study\"",
     "small.toml:1:1: name: expected lower-case letters, digits and hyphens, found \"Small "
     "Study\""},
    {"SeedIsText", "seed = 7", "seed = \"seven\"",
     "small.toml:2:8: seed: expected a whole number from 0 to 2147483647, found \"seven\""},
    {"SeedIsFraction", "seed = 7", "seed = 7.5",
     "small.toml:2:8: seed: expected a whole number from 0 to 2147483647, found 7.5"},
    {"SeedIsNegative", "seed = 7", "seed = -1",
     "small.toml:2:8: seed: expected a whole number from 0 to 2147483647, found -1"},
    {"UnknownKeyAtTop", "seed = 7", "seed = 7\nsede = 8",
     "small.toml:3:1: sede: unknown key; did you mean \"seed\"?"},
    {"UnknownTableAtTop", "[image]", "[imgae]",
     "small.toml:4:2: imgae: unknown key; did you mean \"image\"?"},
    {"WidthTooSmall", "width = 64", "width = 8",
     "small.toml:5:9: image.width: expected a whole number from 16 to 8192, found 8"},
    {"UnknownImageKey", "height = 36", "hight = 36",
     "small.toml:6:1: image.hight: unknown key; did you mean \"height\"?"},
    {"SceneHasNoSource", "builtin = \"sculpture\"\n", "",
     "small.toml:8:1: scenes.box: expected either \"file\" (glTF, in the scenes folder) or "
     "\"builtin\", found neither"},
    {"SceneHasTwoSources", "builtin = \"sculpture\"", "builtin = \"sculpture\"\nfile = \"a.gltf\"",
     "small.toml:8:1: scenes.box: expected either \"file\" (glTF, in the scenes folder) or "
     "\"builtin\", found both"},
    {"RadiusMissing", "radius = 0.2\n", "",
     "small.toml:8:1: scenes.box.radius: expected a number from 0.0001 to 10000, found nothing; "
     "add \"radius\" here"},
    {"RadiusIsZero", "radius = 0.2", "radius = 0",
     "small.toml:10:10: scenes.box.radius: expected a number from 0.0001 to 10000, found 0"},
    {"RadiusIsText", "radius = 0.2", "radius = \"wide\"",
     "small.toml:10:10: scenes.box.radius: expected a number from 0.0001 to 10000, found \"wide\""},
    {"CameraMissing", "camera = { position = [0, 1, 3], target = [0, 0.5, 0], fovDegrees = 40 }\n",
     "",
     "small.toml:8:1: scenes.box.camera: expected a camera, found nothing; add \"camera\" here"},
    {"CameraHasTwoCoordinates", "[0, 1, 3]", "[0, 1]",
     "small.toml:11:23: scenes.box.camera.position: expected three numbers from -1000000 to "
     "1000000, found an array of 2"},
    {"CameraCoordinateIsText", "[0, 1, 3]", "[0, \"up\", 3]",
     "small.toml:11:27: scenes.box.camera.position[2]: expected a number from -1000000 to 1000000, "
     "found \"up\""},
    {"CameraLooksAtItself", "target = [0, 0.5, 0]", "target = [0, 1, 3]",
     "small.toml:11:10: scenes.box.camera: expected a target apart from the position and a view "
     "direction that is not along \"up\""},
    {"CameraLooksAlongUp", "target = [0, 0.5, 0]", "target = [0, 5, 3]",
     "small.toml:11:10: scenes.box.camera: expected a target apart from the position and a view "
     "direction that is not along \"up\""},
    {"FovTooWide", "fovDegrees = 40", "fovDegrees = 170",
     "small.toml:11:69: scenes.box.camera.fovDegrees: expected a number from 1 to 120, found 170"},
    {"UnknownCameraKey", "fovDegrees = 40", "fov = 40",
     "small.toml:11:56: scenes.box.camera.fov: unknown key; did you mean \"fovDegrees\"?"},
    {"LevelHasNoLight", "ambient = [1, 1, 1]", "white = 2",
     "small.toml:13:1: levels.low: expected exactly one of \"ambient\", \"sky\" and "
     "\"environment\", found none"},
    {"LevelHasTwoLights", "ambient = [1, 1, 1]", "ambient = [1, 1, 1]\nenvironment = \"hall.hdr\"",
     "small.toml:13:1: levels.low: expected exactly one of \"ambient\", \"sky\" and "
     "\"environment\", found several"},
    {"SunHasNoElevation", "azimuthDegrees = 30, elevationDegrees = 50", "azimuthDegrees = 30",
     "small.toml:18:7: levels.high.sun.elevationDegrees: expected a number from 0.5 to 90, found "
     "nothing; add \"elevationDegrees\" here"},
    {"SunBelowHorizon", "elevationDegrees = 50", "elevationDegrees = -5",
     "small.toml:18:49: levels.high.sun.elevationDegrees: expected a number from 0.5 to 90, found "
     "-5"},
    {"UnknownSunKey", "elevationDegrees = 50", "elevationDegrees = 50, colour = [1, 1, 1]",
     "small.toml:18:53: levels.high.sun.colour: unknown key; one of: azimuthDegrees, "
     "elevationDegrees, irradiance"},
    {"UnknownCurve", "ambient = [1, 1, 1]", "ambient = [1, 1, 1]\ncurve = \"rheinhard\"",
     "small.toml:15:9: levels.low.curve: expected one of \"clamp\", \"reinhard\", \"aces\", "
     "\"neutral\", found \"rheinhard\"; did you mean \"reinhard\"?"},
    {"TechniqueMissing", "technique = \"none\"\n", "",
     "small.toml:20:1: techniques.none.technique: expected a text in quotes, found nothing; add "
     "\"technique\" here"},
    {"SettingIsText", "samples = 24", "samples = \"many\"",
     "small.toml:25:11: techniques.blizzard24.samples: expected a number, true or false, found "
     "\"many\""},
    {"PresetIsNumber", "samples = 24", "preset = 3",
     "small.toml:25:10: techniques.blizzard24.preset: expected a text in quotes, found 3"},
    {"NoConditions",
     "[[conditions]]\nid = \"one\"\nscene = \"box\"\nlevel = \"low\"\npair = [\"none\", "
     "\"blizzard24\"]\n",
     "",
     "small.toml:1:1: conditions: expected at least one [[conditions]] table, found nothing; add "
     "\"conditions\" here"},
    {"IdMissing", "id = \"one\"\n", "",
     "small.toml:31:1: conditions[1].id: expected a text in quotes, found nothing; add \"id\" "
     "here"},
    {"IdTwice", "[trial]",
     "[[conditions]]\nid = \"one\"\nscene = \"box\"\nlevel = \"high\"\npair = [\"none\", "
     "\"blizzard24\"]\n\n[trial]",
     "small.toml:37:1: conditions[2]: expected a new id, found \"one\" again"},
    {"UnknownScene", "scene = \"box\"", "scene = \"bok\"",
     "small.toml:33:9: conditions[1].scene: expected the name of a scene under [scenes], found "
     "\"bok\"; did you mean \"box\"?"},
    {"UnknownLevel", "level = \"low\"", "level = \"lwo\"",
     "small.toml:34:9: conditions[1].level: expected the name of a level under [levels], found "
     "\"lwo\"; did you mean \"low\"?"},
    {"PairMissing", "pair = [\"none\", \"blizzard24\"]\n", "",
     "small.toml:31:1: conditions[1]: expected either \"pair\", the names of two techniques, or "
     "\"roles\", a technique for each image's role, found neither"},
    {"PairHasThree", "[\"none\", \"blizzard24\"]", "[\"none\", \"blizzard24\", \"wide\"]",
     "small.toml:35:8: conditions[1].pair: expected the names of two techniques, found an array of "
     "3"},
    {"PairNamesUnknownTechnique", "[\"none\", \"blizzard24\"]", "[\"none\", \"blizard24\"]",
     "small.toml:35:17: conditions[1].pair[2]: expected the name of a technique under "
     "[techniques], found \"blizard24\"; did you mean \"blizzard24\"?"},
    {"PairIsOneTechniqueTwice", "[\"none\", \"blizzard24\"]", "[\"none\", \"none\"]",
     "small.toml:35:8: conditions[1].pair: expected different techniques, found \"none\" "
     "twice"},
    {"PairDiffersInLevel", "[\"none\", \"blizzard24\"]",
     "[\"none\", { technique = \"blizzard24\", level = \"high\" }]",
     "small.toml:35:53: conditions[1].pair[2].level: the images of a condition may differ only in "
     "the "
     "technique; \"level\" belongs to the condition"},
    {"PairDiffersInCamera", "[\"none\", \"blizzard24\"]",
     "[\"none\", { technique = \"blizzard24\", camera = { fovDegrees = 50 } }]",
     "small.toml:35:54: conditions[1].pair[2].camera: the images of a condition may differ only in "
     "the "
     "technique; \"camera\" belongs to the condition"},
    {"PairDiffersInRadius", "[\"none\", \"blizzard24\"]", "[\"wide\", \"blizzard24\"]",
     "small.toml:35:8: conditions[1].pair: the images of a condition may differ only in the "
     "technique; "
     "\"wide\" has radius 0.5 m, \"blizzard24\" 0.2 m. Give both the same, or none, and the "
     "scene's radius is used"},
    {"UnknownConditionKey", "level = \"low\"", "level = \"low\"\nlevels = \"high\"",
     "small.toml:35:1: conditions[1].levels: unknown key; did you mean \"level\"?"},
    {"PreferenceAboveOne", "level = \"low\"", "level = \"low\"\nsimulatedPreference = 1.5",
     "small.toml:35:23: conditions[1].simulatedPreference: expected a number from 0 to 1, found "
     "1.5"},
    {"MaskTooShort", "mask = 2.0", "mask = 0.01",
     "small.toml:38:8: trial.mask: expected a number from 0.1 to 60, found 0.01"},
    {"GreyTooBright", "grey = 128", "grey = 300",
     "small.toml:39:8: trial.grey: expected a whole number from 0 to 255, found 300"},
    {"GreyIsFraction", "grey = 128", "grey = 127.5",
     "small.toml:39:8: trial.grey: expected a whole number from 0 to 255, found 127.5"},
    {"UnknownOrdering", "[texts]", "[ordering]\nscheme = \"tesis\"\n\n[texts]",
     "small.toml:42:10: ordering.scheme: expected one of \"thesis\", \"latin\", \"williams\", "
     "\"shuffle\", \"listed\", \"staircase\", \"quest\", \"information\", found \"tesis\"; did you "
     "mean \"thesis\"?"},
    {"TextsMissing",
     "[texts]\ninstructions = \"Look.\"\nstart = \"Start\"\nquestion = \"Which?\"\nfirst = "
     "\"first\"\nsecond = \"second\"\nthanks = \"Thanks\"\n",
     "",
     "small.toml:1:1: texts: expected what participants read, found nothing; add \"texts\" here"},
    {"QuestionEmpty", "question = \"Which?\"", "question = \"\"",
     "small.toml:44:12: texts.question: expected a text that is not empty, found \"\""},
    {"ProgressMisspelt", "thanks = \"Thanks\"",
     "thanks = \"Thanks\"\nprogress = \"{pear} / {pairs}\"",
     "small.toml:48:12: texts.progress: expected no braces but those of {pair} and {pairs}, found "
     "\"{pear} / {pairs}\""},
    {"BiasTooLarge", "[texts]", "[simulation]\npositionBias = 0.7\n\n[texts]",
     "small.toml:42:16: simulation.positionBias: expected a number from -0.5 to 0.5, found 0.7"},
    {"LapseNegative", "[texts]", "[simulation]\nlapse = -0.1\n\n[texts]",
     "small.toml:42:9: simulation.lapse: expected a number from 0 to 1, found -0.1"},
};

} // namespace obscura
