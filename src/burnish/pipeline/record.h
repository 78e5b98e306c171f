#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/measure/noise_certificate.h"

namespace burnish {

/// One step of a run: "merge" by "cells" with every parameter as it was used.
struct Step {
  std::string verb;
  std::string method;
  Settings settings;
  Facts facts;
  double seconds = 0;
  std::vector<FieldInfo> fields;  ///< of the settings, where known: their units and explanations
};

/// The mesh at one moment of the run: "original", "phase 1", "phase 2", ...
struct Phase {
  std::string name;
  TriangleMesh mesh;
  std::vector<float> deviation;  ///< per vertex the distance to a true surface, m; empty: no truth
};

/// Where a depth camera stood, in the world.
struct Viewpoint {
  Camera camera;
  RigidTransform T_world_camera;
};

/// What was done, to what, with which result: what a report is made from.
struct Record {
  std::string title;    ///< "Reconstruction of teapot-scan"
  std::string command;  ///< as it was typed
  std::vector<std::string> inputs;
  std::vector<Step> steps;
  std::vector<Phase> phases;
  std::vector<std::pair<std::string, Facts>>
      comparisons;                              ///< against a true surface, by phase name
  std::optional<NoiseCertificate> certificate;  ///< where smoothing was bounded by the noise
  std::optional<Viewpoint> viewpoint;  ///< of the first frame: pictures show the surface from there
  std::vector<std::string> notes;      ///< what a reader of files or a step wants to be known
  std::vector<std::pair<std::string, std::string>> versions;  ///< burnish, compiler, libraries
};

}  // namespace burnish
