/// @file calls.h
/// Makes the calls of RcServerClient from its arguments. Every function throws InvalidArgumentException if an argument
/// is not allowed.
#ifndef AIBO_DRIVER_CLIENT_CALLS_H
#define AIBO_DRIVER_CLIENT_CALLS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/walk.h"
#include "client/call.h"

namespace aibo_client {

Call callForPicture(int quality, std::optional<Resolution> resolution = std::nullopt);
Call callForMotors(bool on);
Call callToHold(const std::vector<int>& joints);
Call callForPosture(Posture posture);

Call callToPlay(const std::string& name, int repetitions = 1, bool leaves_out_missing_joints = false);
/// @param name empty means all motions
Call callToStop(const std::string& name);
Call callToStore(const std::string& name, const std::vector<std::uint8_t>& content,
                 bool leaves_out_missing_joints = false);
Call callToDelete(const std::string& name);

Call callToSavePicture(int quality);
Call callToFetchPicture(const std::string& name);
Call callToDeletePicture(const std::string& name);

/// @param samples the samples of the part. Without samples, the call stops the sound
Call callToPlaySamples(const SoundPart& part, const std::vector<std::int16_t>& samples);
Call callForVolume(int volume);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CALLS_H
