// In place of the library of Lab Streaming Layer, which no package source of ours has: its
// functions as its header lsl_c.h declares them, and a file, named by FAKE_LSL, of all that was
// pushed.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {
std::string stream;
int consumers = 1;
} // namespace

extern "C" {

void* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels, double rate,
                            int format, const char* source) {
    stream = std::string(name) + " " + type + " " + std::to_string(channels) + " " +
             std::to_string(static_cast<int>(rate)) + " " + std::to_string(format) + " " + source;
    return &stream;
}
void lsl_destroy_streaminfo(void*) {}
void* lsl_create_outlet(void* info, std::int32_t, std::int32_t) { return info; }
void lsl_destroy_outlet(void*) {}
std::int32_t lsl_wait_for_consumers(void*, double) { return consumers; }
std::int32_t lsl_have_consumers(void*) { return consumers; }
double lsl_local_clock() { return 1000; }
std::int32_t lsl_push_sample_strtp(void* outlet, const char** sample, double time) {
    std::FILE* file = std::fopen(std::getenv("FAKE_LSL"), "a");
    std::fprintf(file, "%s|%.3f|%s", static_cast<std::string*>(outlet)->c_str(), time, sample[0]);
    std::fclose(file);
    return 0;
}

void fake_lsl_consumers(int count) { consumers = count; }
}
