#include "simulator/ers7/camera/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace simulated_ers7 {
namespace {

/// The share of the light that reaches the corners.
const Color kCornerLight(0.70, 0.74, 0.80);

/// The share of its light that a pixel gives to each neighbour.
constexpr double kBlur = 0.20;

/// Several pixels of a row that are computed together with vector instructions.
using Numbers = Eigen::Map<Eigen::ArrayXd>;
using ConstNumbers = Eigen::Map<const Eigen::ArrayXd>;

ConstNumbers numbersFrom(const Color* first, std::size_t pixels) {
  return ConstNumbers(first->data(), 3 * static_cast<Eigen::Index>(pixels));
}

Numbers numbersFrom(Color* first, std::size_t pixels) {
  return Numbers(first->data(), 3 * static_cast<Eigen::Index>(pixels));
}

template <typename Values>
auto blurred(const Values& before, const Values& here, const Values& after) {
  return (1 - 2 * kBlur) * here + kBlur * (before + after);
}

LightImage makeTransmission() {
  LightImage transmission;
  const double corner = std::hypot(kPictureWidth / 2.0, kPictureHeight / 2.0);
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      const double radius = std::hypot(x + 0.5 - kPictureWidth / 2.0, y + 0.5 - kPictureHeight / 2.0) / corner;
      transmission.push_back(1 - radius * radius * (1 - kCornerLight));
    }
  }
  return transmission;
}

/// The steps of the tone curve. Light that is brighter than kBrightestLight is white.
constexpr int kToneSteps = 4096;
constexpr double kBrightestLight = 2.0;

/// How many random values there are: a power of two, so that one random number gives several values, by its bits.
constexpr std::uint64_t kRandomValues = 4096;

/// The deviation of the noise at medium gain, in 1/255. With it, pictures of the scene have 3 to 6 KB at quality 85, as
/// in the report (section 3.3.3).
constexpr float kNoiseY = 1.5f;
constexpr float kNoiseColor = 1.0f;

/// Steele's fast splittable generator ("SplitMix64").
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

/// The usual power law, but bright light is compressed instead of clipped.
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

/// A brightness of 1 suits the room. Sony's steps are (Model Information ERS-7): gain -6, 0, +6 dB, shutter 1/50,
/// 1/100, 1/200 s.
double gainOf(const CameraSettings& settings) {
  return settings.auto_exposure ? 1 : std::pow(2.0, static_cast<double>(settings.gain) - ocamparamGAIN_MID);
}

double exposureOf(const CameraSettings& settings) {
  return settings.auto_exposure
             ? 1
             : gainOf(settings) * std::pow(2.0, static_cast<double>(ocamparamSHUTTER_MID) - settings.shutter);
}

/// The room's light has 5000 K. This light looks bluish with the setting for lamps (2856 K), and warm with the setting
/// for daylight (6500 K).
Color whiteBalanceOf(const CameraSettings& settings) {
  if (settings.auto_white_balance || settings.white_balance == ocamparamWB_FL_MODE) {
    return Color::Ones();
  }
  return settings.white_balance == ocamparamWB_INDOOR_MODE ? Color(0.72, 1.0, 1.55) : Color(1.10, 1.0, 0.86);
}

/// The number of steps of the tone curve for one unit of light, for each colour.
Color stepsOf(const CameraSettings& settings) {
  return whiteBalanceOf(settings) * (exposureOf(settings) * (kToneSteps - 1) / kBrightestLight);
}

}  // namespace

Lens::Lens()
    : transmission_(makeTransmission()),
      blurred_across_(kPictureWidth * kPictureHeight),
      projected_(kPictureWidth * kPictureHeight) {}

const LightImage& Lens::project(const LightImage& light) {
  for (std::size_t y = 0; y < kPictureHeight; ++y) {
    const Color* row = &light[y * kPictureWidth];
    Color* out = &blurred_across_[y * kPictureWidth];
    out[0] = blurred(row[0], row[0], row[1]);
    numbersFrom(out + 1, kPictureWidth - 2) =
        blurred(numbersFrom(row, kPictureWidth - 2), numbersFrom(row + 1, kPictureWidth - 2),
                numbersFrom(row + 2, kPictureWidth - 2));
    out[kPictureWidth - 1] = blurred(row[kPictureWidth - 2], row[kPictureWidth - 1], row[kPictureWidth - 1]);
  }
  for (std::size_t y = 0; y < kPictureHeight; ++y) {
    const Color* here = &blurred_across_[y * kPictureWidth];
    const Color* above = y > 0 ? here - kPictureWidth : here;
    const Color* below = y < kPictureHeight - 1 ? here + kPictureWidth : here;
    numbersFrom(&projected_[y * kPictureWidth], kPictureWidth) =
        blurred(numbersFrom(above, kPictureWidth), numbersFrom(here, kPictureWidth),
                numbersFrom(below, kPictureWidth)) *
        numbersFrom(&transmission_[y * kPictureWidth], kPictureWidth);
  }
  return projected_;
}

ImageSensor::ImageSensor(std::uint64_t seed)
    : seed_(seed), tone_curve_(makeToneCurve()), random_values_(makeRandomValues()) {}

void ImageSensor::expose(const LightImage& light, const DetailImage& detail, const CameraSettings& settings,
                         longword image_number, YCrCbImage* picture) const {
  const Color scale = stepsOf(settings);
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
  exposeDetail(light, detail, settings, image_number, picture);
}

// A band of fine detail gets as much noise as Y, because both come from the same four pixels of the sensor.
void ImageSensor::exposeDetail(const LightImage& light, const DetailImage& detail, const CameraSettings& settings,
                               longword image_number, YCrCbImage* picture) const {
  const Color scale = stepsOf(settings);
  const float noise = kNoiseY * static_cast<float>(gainOf(settings));
  FastRandom random(~FastRandom(seed_ + image_number).next());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const FineDetail& part = detail[i];
    FineDetail seen = {};
    if (part.lh != 0 || part.hl != 0 || part.hh != 0) {
      const Color steps = light[i] * scale;
      const auto luminance = static_cast<float>(0.299 * steps[0] + 0.587 * steps[1] + 0.114 * steps[2]);
      const auto tone = [&](float relative) {
        const float step = std::clamp(luminance * relative, 0.0f, kToneSteps - 1.0f);
        return tone_curve_[static_cast<std::size_t>(step)];
      };
      seen = fineDetailOf(tone(1 - part.lh - part.hl + part.hh), tone(1 - part.lh + part.hl - part.hh),
                          tone(1 + part.lh - part.hl - part.hh), tone(1 + part.lh + part.hl + part.hh));
    }
    const std::uint64_t bits = random.next();
    picture->y_lh[i] = toByte(128 + seen.lh + noise * random_values_[bits % kRandomValues]);
    picture->y_hl[i] = toByte(128 + seen.hl + noise * random_values_[bits / kRandomValues % kRandomValues]);
    picture->y_hh[i] =
        toByte(128 + seen.hh + noise * random_values_[bits / (kRandomValues * kRandomValues) % kRandomValues]);
  }
}

}  // namespace simulated_ers7
