#pragma once

#include "gl/timer.h"
#include "renderer/probe.h"
#include "viewer/truth.h"

#include <memory>

namespace obscura {

struct PainterState;

// Draws what is wanted, in the current context, with the code that makes stimuli: one G-buffer for
// all panes, one set of light buffers, and the passes of each technique. Whatever a new wish leaves
// as it was is kept: a moved slider runs one technique, and composites its pane; what is on top of
// that, as exposure, composites alone. Whole-number settings compile anew, which is kept too, for
// going back and forth. Nothing is read back from the GPU but where a function says so. All calls
// from one thread, with one context current.
class Painter {
  public:
    // `timing` as honestTiming() finds it. A piece's time is taken when it is drawn.
    explicit Painter(gl::Timing timing);
    ~Painter();

    // Takes this scene for the wishes with that id. The scene is copied to the GPU and may go. An
    // Error leaves the scene that was there.
    void open(SceneId id, const Scene& scene);
    SceneId scene() const;          // 0: none yet
    const Subject& subject() const; // of the scene that was opened; there must be one

    // Called before what draw() does that may take long. What it throws ends the drawing.
    using Step = PaintStep;
    using Progress = PaintProgress;

    // Draws and waits until the GPU has finished. `wanted.scene` must be scene(), and there must be
    // one to four panes and at least one pixel. A `draft`, where the view has to be drawn anew, has
    // textures that are blurred at grazing angles (GpuScene::sharpen). What cannot be drawn (an
    // environment that cannot be read, settings that do not go together) is an Error, and nothing
    // of what is kept is lost.
    Drawn draw(const Wanted& wanted, const Progress& progress = {}, bool draft = false);

    // Draws all of the view anew next time (G-buffer, light, visibility, pictures), so that a time
    // is that of a whole frame. What is compiled stays, and so does the scene.
    void forget();

    // What the last wish needs references for: the reference's kind if it is wanted, then those of
    // ray-traced panes; each once.
    std::vector<TruthKind> truthsWanted() const;
    // Counts up whenever what references start from has changed: scene, camera, size, normals.
    std::uint64_t view() const;
    // What references of the last wish trace from. Draws two G-buffers and reads them back.
    Surfaces surfaces() const;
    // From now on these are the truths of the view that has this number; ignored for other views.
    void take(std::uint64_t view, std::vector<Truth> truths);
    // Copies of what the last wish's panes and reference show; null without a reference. Reads
    // back.
    std::optional<Comparison> comparison();
    // What came of the comparison. The next draw() shows it until something changes.
    void take(Judgement judgement);

    // Of a pane of the last wish; 1 channel, rows from the top. Reads back.
    Image visibility(int pane) const;

    // The last wish at a pixel, from the picture's top left corner; null outside of it, or before
    // anything was drawn. Reads single pixels back.
    std::optional<Probed> probe(int x, int y) const;

  private:
    std::unique_ptr<PainterState> state_;
};

} // namespace obscura
