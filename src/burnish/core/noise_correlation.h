#pragma once

namespace burnish {

// How the noise of a depth camera is shared between neighbouring pixels: it is the sum of
// independent noises, one white and two that are white noise blurred by a Gaussian. Fitted to a real
// Kinect frame with known truth (the Pyramid of the MeshTGV data), whose correlation at 1, 2, 3, 4
// and 6 pixels is .58, .37, .25, .21 and .165; the sum has .58, .38, .25, .20 and .15.

/// Shares of the variance; they add to 1.
inline constexpr double kWhiteShare = 0.32, kFineShare = 0.46,
                        kCoarseShare = 1 - kWhiteShare - kFineShare;
/// Standard deviations of the two blurs, pixels.
inline constexpr double kFineBlur = 1, kCoarseBlur = 5;

}  // namespace burnish
