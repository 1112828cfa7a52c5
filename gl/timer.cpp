#include "gl/timer.h"

#include "gl/draw.h"
#include "gl/program.h"
#include "gl/target.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace obscura::gl {

namespace {

// Something for the GPU to do: as long as `rounds` says.
class Load {
  public:
    Load() : target_(256, 256, std::array{Format::r32f}, false, "load"), program_(program()) {}

    void draw(int rounds) const {
        program_.use();
        program_.set("rounds", rounds);
        State{}.apply();
        target_.bind();
        triangle_.draw();
    }

  private:
    static Program program() {
        ShaderText vertex, fragment;
        vertex.add("void main() { vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);\n"
                   "gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0); }\n",
                   "(load)");
        fragment.add("uniform int rounds;\nlayout(location = 0) out vec4 result;\nvoid main() {\n"
                     "float x = gl_FragCoord.x * 1e-3;\n"
                     "for (int i = 0; i < rounds; ++i) x = fract(x * 3.7 + 0.1);\n"
                     "result = vec4(x); }\n",
                     "(load)");
        return Program("load", vertex, fragment);
    }

    Target target_;
    Program program_;
    ScreenTriangle triangle_;
};

double seconds(const Load& load, int rounds, Timing timing) {
    Timer timer(timing);
    timer.start();
    load.draw(rounds);
    timer.mark();
    return timer.pieces().front();
}

} // namespace

void Timer::start() {
    finish();
    marks_ = 0;
    times_.clear();
    mark();
}

void Timer::mark() {
    if (timing_ == Timing::finish) {
        finish();
        times_.push_back(std::chrono::steady_clock::now());
        return;
    }
    if (marks_ == queries_.size())
        queries_.emplace_back(GLenum{GL_TIMESTAMP});
    glQueryCounter(queries_[marks_++].name(), GL_TIMESTAMP);
}

std::vector<double> Timer::pieces() {
    std::vector<double> result;
    if (timing_ == Timing::finish) {
        for (std::size_t i = 1; i < times_.size(); ++i)
            result.push_back(std::chrono::duration<double>(times_[i] - times_[i - 1]).count());
        return result;
    }
    std::vector<GLuint64> stamps(marks_);
    for (std::size_t i = 0; i < marks_; ++i)
        glGetQueryObjectui64v(queries_[i].name(), GL_QUERY_RESULT, &stamps[i]);
    for (std::size_t i = 1; i < marks_; ++i)
        result.push_back(static_cast<double>(stamps[i] - stamps[i - 1]) * 1e-9);
    return result;
}

TimingChoice honestTiming() {
    const Load load;
    int rounds = 64;
    seconds(load, rounds, Timing::finish); // compiled and warm
    double wall = 0;
    while ((wall = seconds(load, rounds, Timing::finish)) < 0.02 && rounds < (1 << 24))
        rounds *= 2;
    const double queried = seconds(load, rounds, Timing::queries);
    const std::string found = fmt::format("a load of {:.1f} ms by glFinish and clock takes {:.1f} "
                                          "ms by its time stamps",
                                          wall * 1e3, queried * 1e3);
    return std::abs(queried - wall) < 0.1 * wall
               ? TimingChoice{Timing::queries, "GPU time stamps: " + found}
               : TimingChoice{Timing::finish,
                              "glFinish and a steady clock after each pass: " + found};
}

} // namespace obscura::gl
