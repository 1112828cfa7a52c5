#include "renderer/builtin_scenes.h"
namespace obscura::builtin { Scene figures() { return sculpture(); } }
