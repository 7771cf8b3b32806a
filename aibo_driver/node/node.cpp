#include "node/node.h"

#include <netdb.h>
#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/console_backend.h>
#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/network.h>
#include <ros/rosout_appender.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "text/log_lines.h"
#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

void (*print_to_terminal)(void*, ros::console::Level, const char*, const char*, const char*, int) = nullptr;

std::mutex rosout_mutex;
ros::ROSOutAppender* rosout_appender = nullptr;  // guarded by rosout_mutex

/// Publishes all log lines on /rosout, as roscpp would, but as plain text.
class Rosout {
 public:
  Rosout() { exchange(&appender_); }
  ~Rosout() { exchange(nullptr); }
  Rosout(const Rosout&) = delete;
  Rosout& operator=(const Rosout&) = delete;

 private:
  static void exchange(ros::ROSOutAppender* appender) {
    const std::lock_guard<std::mutex> lock(rosout_mutex);
    rosout_appender = appender;
  }

  ros::ROSOutAppender appender_;
};

/// Replaces rosconsole's output to the terminal. All lines of this process come here, also those that roscpp logs about
/// strangers.
void logPlainly(void* event, ros::console::Level level, const char* text, const char* file, const char* function,
                int line) {
  static auto* const lines = new text::LogLines;  // never deleted: lines may come until the very end
  if (const std::optional<std::string> plain = lines->admit(file == nullptr ? "" : file, line, text)) {
    print_to_terminal(event, level, plain->c_str(), file, function, line);
    const std::lock_guard<std::mutex> lock(rosout_mutex);
    if (rosout_appender != nullptr) {
      rosout_appender->log(level, plain->c_str(), file, function, line);
    }
  }
}

// In seconds. A master that answers needs less than 1 s, and roslaunch kills a node after 15 s.
constexpr unsigned kTimeToUnregister = 10;

// How late the kernel may wake roscpp's threads when they only look whether there is something to do. Three of them
// look ten times a second, which took most of an idle driver's processor time. Messages, requests and signals still
// wake them at once. Only new publishers and the end of the node wait for the next look, and nobody notices such a
// short wait.
constexpr std::chrono::nanoseconds kRoscppSlack = std::chrono::milliseconds(200);

/// Starts roscpp. Its threads inherit the timer slack of the thread that starts them.
ros::NodeHandle startWithSlack() {
  ::prctl(PR_SET_TIMERSLACK, kRoscppSlack.count());
  ros::NodeHandle handle;
  ::prctl(PR_SET_TIMERSLACK, 0);  // 0 restores the usual slack
  return handle;
}

// Calls only functions that a signal handler may call.
void endAtOnce(int) {
  constexpr char kReason[] =
      "This node has not ended within 10 s, most likely because the ROS master does not answer. It ends now, without "
      "unregistering.\n";
  if (::write(STDERR_FILENO, kReason, sizeof(kReason) - 1) < 0) {
    // A failure is ignored, because then nobody can read the text.
  }
  ::_exit(EXIT_FAILURE);
}

void end(int) {
  ::signal(SIGINT, SIG_DFL);  // a second signal ends the node at once
  ::signal(SIGTERM, SIG_DFL);
  ros::requestShutdown();
  ::alarm(kTimeToUnregister);
}

// roscpp sets its own handler when the first node handle is made, so this has to come after that.
void endOnSignal() {
  ::signal(SIGALRM, endAtOnce);
  struct sigaction action = {};
  action.sa_handler = end;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

/// True if at least other nodes on this computer can connect to this name or address.
bool isOfThisComputer(const std::string& host) {
  addrinfo* addresses = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, nullptr, &addresses) != 0) {
    return false;
  }
  bool is_own = false;
  for (const addrinfo* each = addresses; each != nullptr && !is_own; each = each->ai_next) {
    const int probe = ::socket(each->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    is_own = probe >= 0 && ::bind(probe, each->ai_addr, each->ai_addrlen) == 0;
    ::close(probe);
  }
  ::freeaddrinfo(addresses);
  return is_own;
}

// With a wrong address, other nodes see the topics of this node but never get a message, and nothing says why.
void warnOfWrongAddress() {
  if (const std::string& host = ros::network::getHost(); !isOfThisComputer(host)) {
    ROS_WARN_STREAM("Other nodes are told to connect to "
                    << host
                    << ", which is not an address of this computer. They will get "
                       "no messages, unless something forwards them. Are ROS_IP "
                       "and ROS_HOSTNAME right?");
  }
}

}  // namespace

ros::NodeHandle inDriverNamespace(const ros::NodeHandle& handle, const std::string& default_namespace) {
  const std::string& name_space = handle.getNamespace();  // an empty name is that of a nodelet in the root namespace
  if (!name_space.empty() && name_space != "/") {
    return handle;
  }
  ROS_INFO_STREAM("Started in the root namespace: topics and services are under /" << default_namespace << ".");
  return {handle, default_namespace};
}

double numberIn(XmlRpc::XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeInt:
      return static_cast<int>(value);
    case XmlRpc::XmlRpcValue::TypeDouble:
      return value;
    default:
      return NAN;
  }
}

std::string describeRefusal(const std::string& name, XmlRpc::XmlRpcValue value, const std::string& allowed) {
  std::string given;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) {
    given = "the text '" + text::plainLine(static_cast<std::string>(value)) + "'";
  } else {
    std::ostringstream written;
    value.write(written);
    given = text::plainLine(written.str());
  }
  return "Parameter " + name + " is " + given + "; it must be " + allowed + ".";
}

double readNumber(const ros::NodeHandle& parameters, const std::string& name, double number, double highest,
                  double lowest) {
  XmlRpc::XmlRpcValue value;
  if (!parameters.getParam(name, value)) {
    return number;
  }
  number = numberIn(value);
  if (!(number >= lowest && number <= highest)) {
    std::ostringstream allowed;
    allowed << "a number, " << lowest << ".." << highest;
    throw std::runtime_error(describeRefusal(parameters.resolveName(name), value, allowed.str()) + " " + kHowToRemove);
  }
  return number;
}

bool readFlag(const ros::NodeHandle& parameters, const std::string& name) {
  bool flag = false;
  XmlRpc::XmlRpcValue value;
  if (parameters.getParam(name, value) && !parameters.getParam(name, flag)) {
    throw std::runtime_error(describeRefusal(parameters.resolveName(name), value, "true or false") + " " +
                             kHowToRemove);
  }
  return flag;
}

void init(int& argc, char** argv, const std::string& name, std::uint32_t options) {
  try {
    ros::init(argc, argv, name, options | ros::init_options::NoRosout);
  } catch (const ros::InvalidNameException& error) {
    std::fprintf(stderr,
                 "%s cannot start: %s NAME:=VALUE gives a topic another name; a parameter has an underscore, as in "
                 "_host:=192.168.1.20.\n",
                 name.c_str(), error.what());
    std::exit(EXIT_FAILURE);
  }
  ros::console::initialize();
  print_to_terminal = std::exchange(ros::console::backend::function_print, logPlainly);
}

int runNode(const std::string& name, const std::function<std::shared_ptr<void>()>& make) {
  const ros::NodeHandle handle = startWithSlack();  // outlives the try block, because logging ends with the last handle
  const Rosout rosout;
  endOnSignal();
  warnOfWrongAddress();
  try {
    std::shared_ptr<void> node = make();
    while (!ros::isShuttingDown()) {  // unlike ros::spin(), callAvailable() sleeps until there is something to do
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(3600));
    }
    node.reset();  // ends calls to the robot: roscpp 1.15 waits below for services that wait for such a call
    ros::waitForShutdown();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("The " << name << " cannot start. " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace aibo_driver::node
