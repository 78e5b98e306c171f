#pragma once

#include <string_view>

namespace burnish {

/// The style sheet of a report: calm on a screen, light or dark as the reader's system, and on
/// paper.
extern const std::string_view kPageStyle;

/// A small script that adds what paper cannot do: showing one view at a time, and one picture
/// large, where the phases can be flipped through in place. Without it all pictures are there.
extern const std::string_view kPageScript;

}  // namespace burnish
