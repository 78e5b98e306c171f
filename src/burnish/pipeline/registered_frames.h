#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/pipeline/record.h"
#include "burnish/registration/sequence_views.h"
#include "burnish/registration/turntable_views.h"
#include "burnish/sensor/frame_sequence.h"

namespace burnish {

/// How the poses of depth frames are found.
struct FrameRegistration {
  enum class Scene { sequence, turntable };
  Scene scene = Scene::sequence;
  /// Depths outside are not looked at, m; farthest 0: no such limit. What stands behind a turntable
  /// does not turn with it.
  double nearest = 0, farthest = 0;
  SequenceViewsParams sequence;
  TurntableViewsParams turntable;
};

/// Where frames were taken from.
struct RegisteredFrames {
  ViewPoses poses;
  std::vector<double> angles;        ///< of the table at every frame, rad; empty without a table
  double axis_elevation = 0;         ///< how far the camera looks down on the table, rad
  std::vector<std::string> reasons;  ///< per frame why it has no pose; empty where it has one
  Facts facts;
};

/// Finds the poses of frames from what they saw (register_sequence, register_turntable); poses that
/// they bring are not looked at. The record gets the step, and a note on whatever was refused.
/// Errors: those of reading a frame; bad_geometry where fewer than two frames can be placed;
/// cancelled.
Result<RegisteredFrames> register_frames(const FrameSequence& frames,
                                         const FrameRegistration& registration, Record& record,
                                         const Context& context = {});

/// All that was found as JSON: frames, pairs, the table.
std::string registration_json(const FrameSequence& frames, const RegisteredFrames& registered);

}  // namespace burnish
