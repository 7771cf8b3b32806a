// Reads stub.cfg. That def.h, entry.h and the description are right shows in RCServer, which is made from them.
#include <gmock/gmock.h>

#include "simulator/openr_host/stub_generator/stub.h"
#include "support/refusal.h"

namespace openr_host {
namespace {

/// Every setting once, in the form of the OPEN-R SDK Programmer's Guide, 2.3.
const char kSample[] =
    "ObjectName : SampleObject\n"
    "NumOfOSubject : 1\n"
    "NumOfOObserver : 2\n"
    "\n"
    "Service : \"SampleObject.Func1.char.S\", null , Ready ()\n"
    "Service : \"SampleObject.Func2.int.O\", Connect (), Notify ()\n"
    "Service : \"SampleObject.Func3.Data.O\", null , Control ()\n"
    "Extra : UpdatePowerStatus()\n"
    "Extra : SendCont()\n";

StubConfiguration parse(const std::string& text) {
  std::istringstream stream(text);
  return readStub(stream, "stub.cfg");
}

std::string errorOf(const std::string& text) {
  return test_support::refusalOf<ConfigurationError>([&] { parse(text); });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(StubConfigurationTest, ReadsEverySetting) {
  const StubConfiguration stub = parse(kSample);
  EXPECT_EQ(stub.object_name, "SampleObject");
  ASSERT_EQ(stub.subjects.size(), 1U);
  EXPECT_EQ(stub.subjects[0].name.service, "Func1");
  EXPECT_EQ(stub.subjects[0].connection_function, "");
  EXPECT_EQ(stub.subjects[0].data_function, "Ready");
  ASSERT_EQ(stub.observers.size(), 2U);
  EXPECT_EQ(stub.observers[0].name.data_type, "int");
  EXPECT_EQ(stub.observers[0].connection_function, "Connect");
  EXPECT_EQ(stub.observers[0].data_function, "Notify");
  EXPECT_THAT(stub.extra_functions, testing::ElementsAre("UpdatePowerStatus", "SendCont"));
}

TEST(StubConfigurationTest, SkipsOtherLines) {
  const StubConfiguration stub = parse(
      "//\r\n// An object: with a remark\r\n//\r\n\r\n  ObjectName : Walker // its class\r\n"
      "NumOfSubject : 1\r\nNumOfObserver : 1\r\n# Service : \"Walker.Old.Data.O\", null, null\r\nanything goes\r\n"
      "Service : \"Walker.Legs.OCommandVectorData.S\", null, Ready()\r\n"
      "Service : \"Walker.Dummy.DoNotConnect.O\" , null , null \r\n");
  EXPECT_EQ(stub.object_name, "Walker");
  EXPECT_EQ(stub.subjects.at(0).data_function, "Ready");
  EXPECT_EQ(stub.observers.at(0).name.text(), "Walker.Dummy.DoNotConnect.O");
}

TEST(StubConfigurationTest, NamesFileAndLineOfWhatIsWrong) {
  const std::string sample = kSample;
  const std::pair<std::string, std::string> rows[] = {
      {replaced(sample, "Connect (), Notify ()", "Connect ()\n, Notify ()"), "stub.cfg:6: .*on this line"},
      {replaced(sample, "SendCont()", "SendCont ()"), "stub.cfg:9: expected a function"},
      {replaced(sample, "NumOfOObserver : 2", "NumOfOObserver : 3"), "stub.cfg:3: NumOfOObserver is 3.*are 2 services"},
      {replaced(sample, "NumOfOSubject : 1", "NumOfOSubject : 2"), "stub.cfg:2: "},
      {replaced(sample, "NumOfOSubject : 1", "NumOfOSubject : 0"),
       "stub.cfg:2: .*\"SampleObject.Dummy.DoNotConnect.S\""},
      {replaced(sample, "Notify ()", "Notify"), "stub.cfg:6: expected a function"},
      {replaced(sample, "Func2.int.O", "Func2.O"), "stub.cfg:6: expected a service name"},
      {replaced(sample, "int.O\"", "int.O"), "stub.cfg:6: expected a service name"},
      {replaced(sample, "NumOfOSubject : 1", "NumOfOSubject : one"), "stub.cfg:2: "},
      {"ObjectName :", "stub.cfg:1: .*found nothing"},
      {"", "no line ObjectName"},
      {"ObjectName : A\nNumOfOSubject : 1\nService : \"A.B.C.S\", null, null\n", "no line NumOfOObserver"},
      {replaced(sample, "Func3", "Func2"), "stub.cfg:7: .*Func2"},
      {replaced(sample, "SendCont", "UpdatePowerStatus"), "stub.cfg:9: "},
      {"ObjectName : A\n" + sample, "stub.cfg:2: a second ObjectName"},
      {sample + "NumOfOSubject : 1\n", "stub.cfg:10: a second NumOfOSubject"},
  };
  for (const auto& [text, problem] : rows) {
    EXPECT_THAT(errorOf(text), testing::ContainsRegex(problem));
  }
}

}  // namespace
}  // namespace openr_host
