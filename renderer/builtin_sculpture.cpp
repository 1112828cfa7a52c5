#include "renderer/builtin_implicit.h"
#include "renderer/builtin_scenes.h"
namespace obscura::builtin { 
Scene sculpture() { Scene s; s.materials.push_back({}); addMesh(s, surfaceOf([](glm::vec3 p){ return cut(glm::length(p-glm::vec3(0,0.5F,0))-0.4F, glm::length(p-glm::vec3(0,0.6F,0.3F))-0.25F,0.03F);}, {{-.5F,0,-.5F},{.5F,1,.5F}},0.01F),0); return s; }
Scene figures() { return sculpture(); }
}
