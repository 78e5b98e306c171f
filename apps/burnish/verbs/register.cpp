#include <fmt/format.h>

#include <filesystem>

#include "../frame_options.h"
#include "../registration_options.h"
#include "../summary.h"
#include "../verb.h"
#include "burnish/io/atomic_writer.h"
#include "burnish/pipeline/registered_frames.h"
#include "burnish/sensor/pose_list.h"

namespace burnish::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> inputs;
  std::string folder;
  FrameTexts frames;
  RegistrationTexts registration;
};

Result<void> register_files(const Options& options, const Session& session,
                            const Context& context) {
  const Result<FrameRegistration> registration = read_registration_texts(options.registration);
  if (!registration) return registration.error();
  const Result<FrameOptions> said = read_frame_texts(options.frames);
  if (!said) return said.error();
  const Result<FrameSequence> frames =
      open_frames({options.inputs.begin(), options.inputs.end()}, *said);
  if (!frames) return frames.error();
  if (frames->size() < 2) {
    return Error{ErrorCode::invalid_argument, "one frame needs no pose; two at least were expected",
                 options.inputs.front()};
  }
  std::error_code failed;
  fs::create_directories(options.folder, failed);
  if (failed) return Error{ErrorCode::io_failure, failed.message(), options.folder};

  Record record;
  const auto found = register_frames(*frames, *registration, record, context);
  if (!found) return found.error();
  const fs::path poses = fs::path(options.folder) / "poses.txt";
  const std::string text = "# x y z qx qy qz qw, camera to world; -: not known\n" +
                           pose_list_text(found->poses.T_world_view, found->reasons);
  if (auto written = write_file(poses, text); !written) return written;
  if (auto written = write_file(fs::path(options.folder) / "registration.json",
                                registration_json(*frames, *found));
      !written) {
    return written;
  }
  for (const std::string& note : frames->notes()) say(session, "note: " + note);
  if (frames->has_poses()) say(session, "note: the poses that the frames bring were not looked at");
  for (const std::string& note : record.notes) say(session, "note: " + note);
  for (const std::string& note : found->poses.notes) say(session, "note: " + note);
  say_steps(session, record);
  say(session,
      fmt::format("{}: the poses of {} of {} frames; burnish reconstruct --poses reads them",
                  poses.string(), found->poses.placed(), frames->size()));
  return {};
}

}  // namespace

Action add_register(CLI::App& app) {
  auto* verb = app.add_subcommand("register", "Find where depth frames were taken from.");
  auto options = std::make_shared<Options>();
  verb->add_option("INPUT", options->inputs, "a folder of depth frames, or single depth images")
      ->required();
  verb->add_option("-o,--output", options->folder,
                   "the folder for poses.txt and registration.json; may be the frames' own")
      ->required();
  add_camera_options(verb, options->frames);
  add_registration_options(verb, options->registration);
  verb->footer(
      "A frame that fits no other with certainty has no pose: poses.txt says - and why, and "
      "reconstruct "
      "leaves it out.\nExamples:\n"
      "  burnish register scan/ -o scan/\n"
      "  burnish register shots/ -o posed/ --turntable --farthest 1.1m\n"
      "  burnish reconstruct shots/ --poses posed/poses.txt -o model.ply");
  return [options](const Session& s, const Context& c) { return register_files(*options, s, c); };
}

}  // namespace burnish::app
