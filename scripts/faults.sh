# Faults for scripts/mutate, one at a time: its name, the file, what is done to it (sed -E), and the test that
# must fail then: program and filter. A fault that no longer fits the code is an error, so that this list
# cannot rot. Add one for each fault that was found in use and that no test had seen. (In ERE, | as the delimiter
# cannot be matched: take #.)

# Of pictures.
fault vao-slope renderer/shaders/ao/vao_plus_plus.glsl \
    's|\(line\.x - scene\) / settings\.radius|1.1 * &|' \
    limits_gl_test 'VaoPlusPlusLimits.HiddenLinesFadeByEquation4' # equation 4
fault horizon-falls renderer/shaders/horizon.glsl \
    's|\(1\.0 - settings\.attenuation \* squared\) \* \(rise - horizon\)|(1.0 - settings.attenuation * squared) * rise|' \
    limits_gl_test '*HorizonLimits.*'
fault horizon-edge renderer/shaders/ao/ambient_occlusion_volumes.glsl \
    's|if \(low <= 0\.0\)|if (low < 0.0)|' \
    limits_gl_test 'ObjectLimits.Volumes*' # an edge that lies in the tangent plane
fault voxel-way renderer/shaders/ao/voxel_ao.glsl \
    's|dot\(opacity, abs\(direction\)\)|dot(opacity, direction * direction)|' \
    limits_gl_test 'ObjectLimits.Cones*'
fault bias-sign renderer/shaders/horizon.glsl \
    's|sine \* biasCosSin\.x \+ sqrt|sine * biasCosSin.x - sqrt|' \
    limits_gl_test '*HorizonLimits.*'
fault sun-swapped renderer/frame/light.cpp \
    's|std::cos\(elevation\) \* std::sin\(azimuth\)|std::cos(elevation) * std::cos(azimuth)|' \
    renderer_test 'SunTest.*'
fault depth-solid matching/truths.cpp \
    's|thickness = reference\.settings\.radius|thickness = 1e3|' \
    match_gl_test 'Truths.*'
fault flattening-for-nothing matching/fit.cpp \
    's|flatteningCost = 1 / 0\.9|flatteningCost = 1|' \
    matching_test 'FitRemap.*'
fault minimum-below-exp renderer/shaders/ao/gtao.glsl \
    's|1\.0 - sign\(settings\.power\) \* \(1\.0|1.0 - (1.0|' \
    techniques_gl_test 'GlTest.TheMinimumOfVisibility*'
fault srgb-toe image/image.cpp \
    's|12\.92f \* linear|12.2f * linear|' \
    image_test 'Srgb.*'
fault flip-exponent metrics/flip.cpp \
    's|0\.7F\)|0.75F)|' \
    metrics_test 'Flip.*'
fault jod-channels metrics/color_video_vdp.cpp \
    's|pixel\[grey \? 0 : 2\]|pixel[grey ? 0 : 1]|' \
    metrics_test 'ColorVideoVdp.*'
fault jod-factor-two metrics/color_video_vdp.cpp \
    's|correction : 2 \* correction|correction : correction|' \
    metrics_test 'ColorVideoVdp.*'
fault jod-border metrics/pyramid.cpp \
    's|padded\[1\] = padded\[2\];|padded[1] = 0;|' \
    metrics_test 'ColorVideoVdp.GivesTheAuthorsNumbers:Pyramid.*'
fault jod-parity metrics/pyramid.cpp \
    's|rows % 2 \? near|columns % 2 ? near|' \
    metrics_test 'Pyramid.RightBorderFollowsTheParityOfRows'
fault radius-lost renderer/techniques/settings.cpp \
    's|settings\.set\("radius", radius, setting\.place\)|settings.set("radius", 100 * radius, setting.place)|' \
    renderer_test 'SettingsTest.*'
fault unmatched-depth renderer/render.cpp \
    's|hashTargets\(inputs, gbuffer\.target\(\), lighting\.readsNormals\(\) \? 3 : 2\)|hashTargets(inputs, gbuffer.target(), 1)|' \
    generate_gl_test 'Generate.DepthIsPartOfWhatMustMatch'
fault emission-unmatched renderer/render.cpp \
    's|hashTarget\(inputs, gbuffer\.target\(\), 4\)|(void)inputs|' \
    generate_gl_test 'Generate.EmissionIsPartOfWhatMustMatch'
fault transform-turned renderer/scene/scene.cpp \
    's|glm::mat2\(c, -s, s, c\)|glm::mat2(c, s, -s, c)|' \
    scene_test 'TextureUse.*'
fault holes-elsewhere renderer/reference/ray_scene.cpp \
    's|use\.at\(vertex\)|vertex.uv|' \
    reference_gl_test '*HolesOfMaskedMaterials'
fault metals-lose-light renderer/shaders/light.frag \
    's|other\.again \+ scattered, metal\.again|other.again + scattered, vec3(0.0)|' \
    frame_gl_test '*AWhiteSurface*'
fault code-forgotten renderer/render.cpp \
    's|std::string\(code\)|std::string(code.substr(0, 0))|' \
    generate_gl_test 'Generate.RendersAgainWhenTheRenderingCodeChanges'
fault index-past-the-end renderer/scene/gltf_json.cpp \
    's|value\.get<double>\(\) >= static_cast<double>\(size\)|value.get<double>() > static_cast<double>(size)|' \
    scene_test 'Gltf*'

# Of files.
fault file-not-flushed base/files.cpp \
    's|= ::fsync\(descriptor\)|= 0|' \
    base_test 'Files.*'
fault foreign-files-removed base/files.cpp \
    's#writer && fs::is_regular_file\(entry\.symlink_status\(\)\) && isGone\(\*writer\)#fs::is_regular_file(entry.symlink_status()) \&\& (!writer || isGone(*writer))#' \
    base_test 'Files.*'
fault row-not-flushed experiment/append_file.cpp \
    's|writeAll\(descriptor_, lines\) && ::fsync\(descriptor_\) == 0|writeAll(descriptor_, lines)|' \
    experiment_test 'AppendFileTest.*'
fault short-rows base/csv.cpp \
    's|record\.cells\.size\(\) != columns|record.cells.size() > columns|' \
    protocols_test 'Responses.*:Csv.*'
fault torn-rows base/csv.cpp \
    's#record\.ended = take\("\\n"\) .*#record.ended = take("\\n") || take("\\r\\n") || atEnd();#' \
    protocols_test 'Responses.*:Csv.*'

fault number-with-a-rest base/arguments.cpp \
    's#readCell\(number, #readCell(number.substr(0, 2), #' \
    base_test 'NamedNumberTest.*'
fault unseen-characters protocols/reader/cell_faults.cpp \
    's#seen != name\)#seen.empty())#' \
    protocols_test '*BadValue*'
fault surface-unchecked image/canvas.cpp \
    's|std::max\(width, height\) > largestSurface|false|' \
    image_test 'Canvas.*'
fault pages-forgotten image/canvas.cpp \
    's|tallestPage = 16000|tallestPage = 160000|' \
    matching_test 'MatchSheet.*'

# Of sessions.
fault missed-threshold experiment/timing_count.cpp \
    's|missedInterval = 1\.2|missedInterval = 1.5|' \
    experiment_test 'Trial.*'
fault key-before-onset experiment/trial.cpp \
    's/visible_ != screen_ \|\| event\.time < since_/visible_ != screen_/' \
    experiment_test 'Trial.*'
fault shown-before-events experiment/play.cpp \
    's|anew = machine\.isOn\(\)|anew = machine.isOn() \|\| machine.screen() >= 0|' \
    experiment_test 'OrderOfEventsTest.*'
fault redraw-taken-for-shown experiment/play.cpp \
    's|anew = machine\.isOn\(\)|anew = machine.isOn() \&\& machine.screen() < -1|' \
    experiment_test 'OrderOfEventsTest.*'
fault minimum-view-lost experiment/trial.cpp \
    's|viewed\(screen_, time\) < phase\(screen_\)\.atLeast|viewed(screen_, time) < 0 * phase(screen_).atLeast|' \
    experiment_test 'MinimumView.*'
fault mask-rounding experiment/refresh.cpp \
    's|seconds \* hz - 0\.25|seconds * hz|' \
    experiment_test 'Refresh.*'
fault late-stamp-ends-mask experiment/timing_count.cpp \
    's/std::min\(before, behind_\)/std::max(before, behind_)/' \
    experiment_test 'RefreshCount.*'
fault blanks-unchecked experiment/timing_check.cpp \
    's/blanks < 1 \|\|/false \&\&/' \
    experiment_test 'DisplayCheck.*'
fault returned-slot-lost experiment/ledger.cpp \
    's|\(record\.state == SlotState::returned\)|(record.state == SlotState::returned \&\& record.slot > 1)|' \
    experiment_test 'LedgerTest.*'
fault design-forgotten experiment/continuity.cpp \
    's|!record\.design\.empty\(\) && record\.design != hash|& \&\& hash.empty()|' \
    experiment_test 'ContinuityTest.*'
fault rehearsal-takes-a-slot experiment/session.cpp \
    's|\(!session\.rehearsal\)|(true)|' \
    experiment_test 'SimulationTest.*'
fault exchange-lost experiment/schedule.cpp \
    's|exchange = place / rows|exchange = 0|' \
    experiment_test 'Schedule.*'
fault mirror-forgotten experiment/schedule.cpp \
    's|forwards\.rbegin\(\), forwards\.rend\(\)|forwards.begin(), forwards.end()|' \
    experiment_test 'Schedule.Williams*'
fault repeat-not-reversed experiment/selection.cpp \
    's|repeat % 2 == 0|repeat > 2|' \
    experiment_test 'Selection.Repeats*'
fault neighbours-alike experiment/selection.cpp \
    's|count\.second <= left\.size|count.second <= 1 + left.size|' \
    experiment_test 'Selection.WhatIsToBeApart*'
fault reversal-at-the-end experiment/staircase.cpp \
    's|level \+ move < 0|level + move < -1|' \
    experiment_test 'Staircase.*'
fault batch-within experiment/adaptive.cpp \
    's|posteriorAfter\(number \* size\)|posteriorAfter(past.size())|' \
    experiment_test 'InformationOrder.*'
fault wins-swapped experiment/adaptive.cpp \
    's|wins\(pair\.second, pair\.first\) \+= second|wins(pair.second, pair.first) += first + 0 * second|' \
    experiment_test 'InformationOrder.*'
fault interrupted-teaches experiment/adaptive.cpp \
    's#past\.interrupted \|\| ##' \
    experiment_test 'QuestOrder.*'
fault scores-unsorted experiment/adaptive.cpp \
    's|byScore\[adaptive\.scores\[i\]\]|byScore[static_cast<double>(i)]|' \
    experiment_test 'QuestOrder.*'
fault quest-noise inference/quest_plus.cpp \
    's|noise_ \* posterior_|0 * (noise_ * posterior_)|' \
    inference_test '*PublishedRun*'
fault quest-cells inference/quest_plus.cpp \
    's|\(1 - confidence\) / 2|(1 - confidence)|' \
    inference_test 'QuestPlus.*'
fault gain-of-choice inference/pair_choice.cpp \
    's|-\(t \* t \+ tails|-(0.5 * t * t + tails|' \
    inference_test 'PairChoice.*'
fault least-gain inference/pair_choice.cpp \
    's|std::max_element\(reductions|std::min_element(reductions|' \
    inference_test 'PairChoice.*'
fault unit-lost experiment/row.cpp \
    's|row\.view2Ms = 1000 \* |row.view2Ms = |' \
    experiment_test 'SimulationTest.TimesAddUp'
fault answer-swapped experiment/row.cpp \
    's|\(row\.chosenPosition == 2\) == \(row\.firstIs == "a"\)|(row.chosenPosition == 2)|' \
    experiment_test 'SimulationTest.*'
fault shuffle-short base/random.h \
    's|below\(static_cast<std::uint32_t>\(i\)\)|below(static_cast<std::uint32_t>(i - 1))|' \
    base_test 'Random.*'

fault signal-unheard experiment/signals.cpp \
    's#if \(noted\)#if (noted \&\& !heeded[0])#' \
    signals_e2e_test '*'

fault break-unchecked experiment/screens.cpp \
    's|instructionsPage\(texts\), restPage\(texts\),|instructionsPage(texts),|' \
    presenter_e2e_test '*ABreaksText*'
fault images-off-screen experiment/screens.cpp \
    's#boxes\.front\(\)\.x < 0 \|\| height > height_#boxes.front().x < 0#' \
    presenter_e2e_test '*BesideEachOther*'
fault torn-table-kept experiment/recorder.cpp \
    's|file\.append\(whole\.substr\(content\.size\(\)\)\)|content.size()|' \
    experiment_test 'RecorderTest.*:Killed.*'
fault finish-not-journalled experiment/recorder.cpp \
    's|keep\("trial_finished"|if (trial % 2) &|' \
    experiment_test 'Killed.*'
fault half-seen-forgotten experiment/broken_session.cpp \
    's|broken\.history\.push_back\(std::move\(past\)\);|if (one.answers) broken.history.push_back(std::move(past));|' \
    experiment_test 'ResumeTest.*'
fault slot-of-another experiment/ledger.cpp \
    's|if \(!same\)|if (false \&\& !same)|' \
    experiment_test 'ResumeRefused.*'
fault ranges-forgotten experiment/form.cpp \
    's|number >= asked\.least \&\& number <= asked\.most|number >= asked.least|' \
    experiment_test 'FormTest.*'
fault role-of-the-other experiment/observer.cpp \
    's|return order\[i\];|return order[order.size() - 1 - i];|' \
    experiment_test 'SimulationTest.*'
fault phases-out-of-the-design protocols/reader/design.cpp \
    's#\{"phases", toJson\(given\)\}#{"phases", toJson(std::vector<Phase>(given.size()))}#' \
    protocols_test 'TrialPhases.*'

# Of statistics and choices.
fault votes-swapped analysis/votes.cpp \
    's|choseB \? tally->votes\.b : tally->votes\.a|choseB ? tally->votes.a : tally->votes.b|' \
    analysis_test 'TallyVotes.*'
fault one-sided inference/counts.cpp \
    's|2 \* binomialLower\(std|binomialLower(std|' \
    inference_test 'Counts/Thesis.*'
fault one-minus-cdf inference/tails.cpp \
    's|cdf\(complement\(boost::math::chi_squared\(df\), statistic\)\)|1 - cdf(boost::math::chi_squared(df), statistic)|' \
    inference_test 'Tails.*'
fault first-tooth inference/power.cpp \
    's|10 \+ 4 / std::abs\(share - 0\.5\)|0 * share|' \
    inference_test 'SampleSize.*'
fault rounded-scores inference/paired.cpp \
    's|score - scores\[origin\]|score - 0 * scores[origin]|' \
    inference_test 'PairedTrend.*'
fault other-images analysis/votes.cpp \
    's|row\.aFirst \? a : b|row.aFirst ? b : a|' \
    analysis_test 'TallyWithStimuli.*'
fault front-of-equals bench/sweep/pareto.cpp \
    's|one\.milliseconds <= other\.milliseconds|one.milliseconds < other.milliseconds|' \
    sweep_test 'ParetoFront.*:DominatedBy.*'
fault caution-silent analysis/summary.cpp \
    's#if \(!caution\.empty\(\)\)#if (caution.size() > 100000)#' \
    analysis_program_test 'Program.Cautions*'
fault look-unscaled experiment/eyes.cpp \
    's|lookDeviation \* random_|random_|' \
    experiment_test 'Eyes.*'
fault worse-for-better protocols/reader/stimuli.cpp \
    's|\) > right;|) < right;|' \
    experiment_test 'Eyes.*'
fault unsure-votes analysis/plan/simulation.cpp \
    's|limitOf\(here\.b \+ here\.unsure\)|limitOf(here.b)|' \
    analysis_test 'Plan.WhoIsNotSureHasNoVote'
fault cut-object renderer/framing.cpp \
    's|margin = 0\.88|margin = 1.2|' \
    renderer_test 'Framing.*'
fault crumbs-count renderer/extent.cpp \
    's|each\.nearest > reach \+ gap|each.nearest > reach + 1e9f * gap|' \
    renderer_test 'Framing.*'
fault looks-through renderer/reference/ray_scene.cpp \
    's|cutout\.oneSided = oneSided|cutout.oneSided = false|' \
    renderer_test 'Sight.*'
fault kept-frames viewer/test_mode.cpp \
    's|painter_\.forget\(\);||' \
    viewer_test_mode_gl_test 'TestModeTest.*'
fault torn-from-remarks protocols/reader/toml_insert.cpp \
    's|lines\.isComment\(last \+ 1\)|false|' \
    protocols_test 'TomlInsert.*'
fault zip-leads-out archive/paths.cpp \
    's#part == "\." \|\| part == "\.\."#part == "."#' \
    archive_test 'Kinds/HostileZips.*:Paths.*'
fault zip-links archive/zip.cpp \
    's|kind != 0 \&\& kind|kind == S_IFIFO \&\& kind|' \
    archive_test 'Kinds/HostileZips.*'
fault zip-bomb archive/zip.cpp \
    's|if \(size\(\) > mostTimes|if (size() / 1000 > mostTimes|' \
    archive_test 'Zip.ManyLarge*'
fault archive-any-rounding archive/pictures.cpp \
    's|other\.rms > oneCode|other.rms > 1e9|' \
    archive_gl_test 'ArchiveTest.AnotherDriver*'
fault archive-other-design archive/study.cpp \
    's|!found\.empty\(\) \&\& found != expected|found == "none"|' \
    archive_gl_test 'ArchiveTest.WhatDoesNotBelong*'
