#include <fmt/format.h>

#include "../frame_options.h"
#include "../verb.h"
#include "burnish/sensor/recording.h"

namespace burnish::app {
namespace {

struct Options {
  std::string recording, folder;
  FrameTexts frames;
  Settings settings;
};

Result<void> import_frames(const Options& options, const Session& session, const Context& context) {
  const Result<ImportParams> params = ImportParams::schema().parse(options.settings);
  if (!params) return params.error();
  const Result<FrameOptions> said = read_frame_texts(options.frames);
  if (!said) return said.error();
  context.stage(fmt::format("importing {}", options.recording));
  const Result<ImportReport> report =
      import_recording(options.recording, options.folder, *params,
                       {said->camera, said->depth_scale, said->sensor}, context);
  if (!report) return report.error();
  say(session, fmt::format("{}: {}", options.recording, report->format));
  for (const Fact& fact : report->facts())
    say(session, fmt::format("{}: {}", fact.key, readable(fact)));
  for (const std::string& note : report->notes) say(session, "note: " + note);
  say(session, fmt::format("{}: frames that `burnish reconstruct` reads", options.folder));
  return {};
}

std::string formats_help() {
  std::string text = "Reads, told by the content:\n";
  for (const RecordingTitle& format : recording_titles())
    text += fmt::format("  {:<10}{}\n", format.name, format.title);
  return text;
}

}  // namespace

Action add_import(CLI::App& app) {
  auto* verb =
      app.add_subcommand("import", "Turn a depth camera's recording into a folder of frames.");
  auto options = std::make_shared<Options>();
  verb->add_option("RECORDING", options->recording, "a file or folder, see below")->required();
  verb->add_option("-o,--output", options->folder,
                   "the folder to write; new, empty, or an earlier import")
      ->required();
  add_camera_options(verb, options->frames);
  add_fields(verb, ImportParams::schema().fields(), options->settings);
  verb->footer(formats_help() +
               "Example:\n  burnish import rgbd_dataset_freiburg1_desk -o desk --every 10");
  return [options](const Session& s, const Context& c) { return import_frames(*options, s, c); };
}

}  // namespace burnish::app
