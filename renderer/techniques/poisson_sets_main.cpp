// Makes the sample sets of VAO++: obscura-poisson-sets SEED > renderer/techniques/poisson_sets.h
#include "renderer/techniques/poisson.h"

#include <fmt/format.h>

#include <cstdlib>

int main(int count, char** arguments) {
    char* end = nullptr;
    const unsigned long seed = count == 2 ? std::strtoul(arguments[1], &end, 10) : 0;
    if (count != 2 || end == arguments[1] || *end != '\0') {
        fmt::print(stderr, "expected a seed, a whole number: obscura-poisson-sets 1\n");
        return 1;
    }
    fmt::print("{}", obscura::poissonTable(seed));
}
