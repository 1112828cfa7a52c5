#pragma once

#include "renderer/frame/composite.h"
#include "viewer/pane_passes.h"
#include "viewer/show_pass.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What the painter keeps, for its own files alone: painter.cpp draws, painter_read.cpp reads back.
struct PainterState {
    explicit PainterState(gl::Timing timing) : clock(timing) {}

    // A truth, and its texture once it is shown.
    struct Reference {
        Truth truth;
        gl::Texture texture;
    };
    // What was drawn last, and from what: as much of it as is wanted again stays.
    struct Picture {
        std::string from;
        std::shared_ptr<const SharedPicture> picture;
    };

    const Truth* truthOf(const std::optional<TruthKind>& kind) const;
    TruthKind referenceKind() const { return {wanted.integral, wanted.view.radius}; }
    bool needsReference() const {
        return wanted.reference || wanted.show == Show::error || wanted.show == Show::jod;
    }
    const Truth* reference() const { return truthOf(referenceKind()); }
    const gl::Texture& referenceTexture();
    std::string judged() const;
    bool isJudged() const { return !judgement.of.empty() && judgement.of == judged(); }
    bool waits(const PanePasses::Pane& pane) const;
    void runTechniques();
    const gl::Texture& composited(const gl::Texture& visibility, bool sendsLight, int guard);
    std::shared_ptr<const SharedPicture> kept(const std::string& from);
    std::string sourceOf(std::size_t index) const;
    void show(std::size_t index, const SharedPicture& into);
    std::shared_ptr<const SharedPicture> shown(std::size_t index);
    std::shared_ptr<const SharedPicture> difference(const Drawn& drawn);
    Drawn summary() const;

    PicturePool pool;
    ShowPass showPass;
    PanePasses passes;
    SceneId scene = 0;
    std::optional<Subject> subject;
    std::optional<ViewBuffers> buffers; // of the subject
    std::optional<Composite> composite;
    std::array<int, 2> compositeSize{};

    Wanted wanted; // that was drawn last
    std::string look;
    std::vector<PanePasses::Pane*> panes; // of it
    std::vector<PanePasses::Pane*> ran;   // those that had to run for it
    std::uint64_t view = 0;               // counts scenes, cameras, sizes and normals
    std::vector<Reference> references;
    Judgement judgement;
    std::vector<gl::Texture> jodMaps; // of the judgement, by pane
    std::vector<Picture> pictures, older;
    PieceClock clock;
    double gbufferMs = 0, lightMs = 0;
};

} // namespace obscura
