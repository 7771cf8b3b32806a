#include "simulator/ers7/camera/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace simulated_ers7 {
namespace {

/// Of the tone curve; light beyond the last one is white.
constexpr int kToneSteps = 4096;
constexpr double kBrightestLight = 2.0;

/// A power of two, so that some bits of a random number choose one.
constexpr std::uint64_t kRandomValues = 4096;

/// Deviation of the noise, in 1/255, at medium gain: with it a picture of the scene has, at JPEG quality 85, the 3 to
/// 6 KB of the report's (section 3.3.3).
constexpr float kNoiseY = 1.5f;
constexpr float kNoiseColor = 1.0f;

/// Steele's splittable generator ("SplitMix64"): one addition and a good mix per number.
class FastRandom {
 public:
  explicit FastRandom(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
  }

 private:
  std::uint64_t state_;
};

/// The usual power law, with a shoulder instead of a hard end: bright light is compressed, not cut.
std::vector<float> makeToneCurve() {
  std::vector<float> curve;
  for (int step = 0; step < kToneSteps; ++step) {
    const double light = step * kBrightestLight / (kToneSteps - 1);
    const double soft = light < 0.7 ? light : 0.7 + 0.3 * (1 - std::exp(-(light - 0.7) / 0.3));
    curve.push_back(static_cast<float>(255 * std::pow(soft, 1 / 2.2)));
  }
  return curve;
}

std::vector<float> makeRandomValues() {
  std::mt19937 generator;
  std::normal_distribution<float> distribution;
  std::vector<float> values(kRandomValues);
  std::generate(values.begin(), values.end(), [&] { return distribution(generator); });
  return values;
}

/// Light per light, 1 = right for the room. The steps are those of Sony's Model Information ERS-7: gain -6, 0, +6 dB,
/// shutter 1/50, 1/100, 1/200 s.
double gainOf(const CameraSettings& settings) {
  return settings.auto_exposure ? 1 : std::pow(2.0, static_cast<double>(settings.gain) - ocamparamGAIN_MID);
}

double exposureOf(const CameraSettings& settings) {
  return settings.auto_exposure
             ? 1
             : gainOf(settings) * std::pow(2.0, static_cast<double>(ocamparamSHUTTER_MID) - settings.shutter);
}

/// The room is lit by 5000 K. Set for warmer lamps (2856 K) the camera shows it bluish, set for daylight (6500 K) warm.
Color whiteBalanceOf(const CameraSettings& settings) {
  if (settings.auto_white_balance || settings.white_balance == ocamparamWB_FL_MODE) {
    return Color::Ones();
  }
  return settings.white_balance == ocamparamWB_INDOOR_MODE ? Color(0.72, 1.0, 1.55) : Color(1.10, 1.0, 0.86);
}

}  // namespace

ImageSensor::ImageSensor(std::uint64_t seed)
    : seed_(seed), tone_curve_(makeToneCurve()), random_values_(makeRandomValues()) {}

void ImageSensor::expose(const LightImage& light, const CameraSettings& settings, longword image_number,
                         YCrCbImage* picture) const {
  const Color scale = whiteBalanceOf(settings) * (exposureOf(settings) * (kToneSteps - 1) / kBrightestLight);
  const auto gain = static_cast<float>(gainOf(settings));
  const float noise_y = kNoiseY * gain;
  const float noise_color = kNoiseColor * gain;
  FastRandom random(FastRandom(seed_ + image_number).next());
  const auto tone = [this](double value) {
    return tone_curve_[static_cast<std::size_t>(std::min(value, kToneSteps - 1.0))];
  };
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Color steps = light[i] * scale;
    const YCrCb color = toYCrCb(tone(steps[0]), tone(steps[1]), tone(steps[2]));
    const std::uint64_t bits = random.next();
    picture->y[i] = toByte(color.y + noise_y * random_values_[bits % kRandomValues]);
    picture->cr[i] = toByte(color.cr + noise_color * random_values_[bits / kRandomValues % kRandomValues]);
    picture->cb[i] =
        toByte(color.cb + noise_color * random_values_[bits / (kRandomValues * kRandomValues) % kRandomValues]);
  }
}

}  // namespace simulated_ers7
