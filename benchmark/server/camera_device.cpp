// Stands in for a camera where programs read a Video4Linux device. It needs no module of the kernel.
//
//   LD_PRELOAD=libcamera_device.so CAMERA_DEVICE=FILE PROGRAM
//
// FILE is the device's path. It has the camera's pictures, 208x160, YUYV, one after the other, at most 16. When PROGRAM
// opens it, it gets a timer instead, which becomes readable 30 times a second; so select, poll and close are those of
// the kernel. Each buffer is filled once, when it is mapped, so a picture costs PROGRAM no more than one that a device
// has written to its memory.
//
// It knows what ustreamer needs and no more: one format, one rate, buffers that are mapped, functions with their names
// on 64-bit systems.
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <mutex>

namespace {

constexpr std::uint32_t kWidth = 208;
constexpr std::uint32_t kHeight = 160;
constexpr std::uint32_t kPictureSize = kWidth * kHeight * 2;
constexpr std::uint32_t kMostBuffers = 16;
constexpr std::uint32_t kRate = 30;

/// What the program would have called without this library.
template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int failWith(int error) {
  errno = error;
  return -1;
}

class Camera {
 public:
  /// @return the timer, which stands for the device
  int open(int pictures) {
    pictures_ = pictures;
    timer_ = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    return timer_;
  }

  bool is(int descriptor) const { return descriptor >= 0 && descriptor == timer_; }

  /// @param request has 32 bits for the kernel; what programs have in the others, if they keep it in an int, is its
  /// sign
  int control(std::uint32_t request, void* argument) {
    switch (request) {
      case VIDIOC_QUERYCAP:
        return describe(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_S_INPUT:
        return *static_cast<int*>(argument) == 0 ? 0 : failWith(EINVAL);
      case VIDIOC_G_FMT:
      case VIDIOC_S_FMT:
        return tellFormat(*static_cast<v4l2_format*>(argument));
      case VIDIOC_G_PARM:
      case VIDIOC_S_PARM:
        return tellRate(*static_cast<v4l2_streamparm*>(argument));
      case VIDIOC_REQBUFS:
        return makeBuffers(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return describe(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return queue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return takePicture(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        return run(1000000000 / kRate);
      case VIDIOC_STREAMOFF:
        return run(0);
      default:
        return failWith(ENOTTY);
    }
  }

  /// Fills a buffer's memory with its picture.
  bool fill(void* memory, std::size_t size, off_t offset) const {
    return ::pread(pictures_, memory, size, offset) == static_cast<ssize_t>(size);
  }

 private:
  static int describe(v4l2_capability& capability) {
    capability = {};
    std::strcpy(reinterpret_cast<char*>(capability.driver), "camera_device");
    std::strcpy(reinterpret_cast<char*>(capability.card), "pictures of a file");
    capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    capability.capabilities = capability.device_caps | V4L2_CAP_DEVICE_CAPS;
    return 0;
  }

  static int tellFormat(v4l2_format& format) {
    format.fmt.pix.width = kWidth;
    format.fmt.pix.height = kHeight;
    format.fmt.pix.pixelformat = V4L2_PIX_FMT_YUYV;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    format.fmt.pix.bytesperline = kWidth * 2;
    format.fmt.pix.sizeimage = kPictureSize;
    format.fmt.pix.colorspace = V4L2_COLORSPACE_SRGB;
    return 0;
  }

  static int tellRate(v4l2_streamparm& parameters) {
    parameters.parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    parameters.parm.capture.timeperframe = {1, kRate};
    return 0;
  }

  int makeBuffers(v4l2_requestbuffers& buffers) {
    if (buffers.memory != V4L2_MEMORY_MMAP) {
      return failWith(EINVAL);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.clear();
    buffers.count = std::min(buffers.count, kMostBuffers);
    return 0;
  }

  // A buffer's place in the device's memory is that of its picture in the file.
  static int describe(v4l2_buffer& buffer) {
    buffer.length = kPictureSize;
    buffer.m.offset = buffer.index * kPictureSize;
    return buffer.index < kMostBuffers ? 0 : failWith(EINVAL);
  }

  int queue(const v4l2_buffer& buffer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(buffer.index);
    return 0;
  }

  // If no buffer is free, the picture is lost, as with a device.
  int takePicture(v4l2_buffer& buffer) {
    std::uint64_t ticks = 0;
    if (::read(timer_, &ticks, sizeof ticks) != sizeof ticks) {
      return -1;  // there is no picture yet; read() has set errno
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    sequence_ += static_cast<std::uint32_t>(ticks);
    if (free_.empty()) {
      return failWith(EAGAIN);
    }
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    buffer.index = free_.front();
    free_.pop_front();
    buffer.bytesused = kPictureSize;
    buffer.length = kPictureSize;
    buffer.flags = V4L2_BUF_FLAG_MAPPED | V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    buffer.timestamp = {now.tv_sec, now.tv_nsec / 1000};
    buffer.sequence = sequence_;
    return 0;
  }

  int run(long period) const {
    const itimerspec times{{0, period}, {0, period}};
    return ::timerfd_settime(timer_, 0, &times, nullptr);
  }

  std::atomic<int> timer_{-1};
  int pictures_ = -1;
  std::mutex mutex_;  // guards what follows
  std::deque<std::uint32_t> free_;
  std::uint32_t sequence_ = 0;
};

Camera& camera() {
  static Camera the_camera;
  return the_camera;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);  // nobody looks at it unless the flags say that there is one
  va_end(arguments);
  static auto* const next_open = next<int(const char*, int, ...)>("open");
  const char* const device = std::getenv("CAMERA_DEVICE");
  if (device == nullptr || std::strcmp(path, device) != 0) {
    return next_open(path, flags, mode);
  }
  const int pictures = next_open(path, O_RDONLY | O_CLOEXEC);
  return pictures < 0 ? pictures : camera().open(pictures);
}

int ioctl(int descriptor, unsigned long request, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  static auto* const next_ioctl = next<int(int, unsigned long, ...)>("ioctl");
  return camera().is(descriptor) ? camera().control(static_cast<std::uint32_t>(request), argument)
                                 : next_ioctl(descriptor, request, argument);
}

void* mmap(void* address, size_t size, int protection, int flags, int descriptor, off_t offset) noexcept {
  static auto* const next_mmap = next<void*(void*, size_t, int, int, int, off_t)>("mmap");
  if (!camera().is(descriptor)) {
    return next_mmap(address, size, protection, flags, descriptor, offset);
  }
  void* const memory = next_mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory != MAP_FAILED && camera().fill(memory, size, offset) ? memory : MAP_FAILED;
}

}  // extern "C"
