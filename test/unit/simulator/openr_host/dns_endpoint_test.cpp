// DNS endpoints, from an object's point of view (OPEN-R SDK Internet Protocol Version4, chapters 4 and 9). They ask
// this computer's resolver, which knows localhost from its own files.
#include <DNSEndpointMsg.h>
#include <EndpointTypes.h>
#include <gmock/gmock.h>
#include <netdb.h>

#include <string>

#include "test_system.h"

// The linker replaces getaddrinfo() by __wrap_..., which can call the original as __real_.... This computer's resolver
// may know no host with several addresses.
extern "C" int __real_getaddrinfo(const char* name, const char* service, const addrinfo* hints, addrinfo** hosts);
extern "C" int __wrap_getaddrinfo(const char* name, const char* service, const addrinfo* hints, addrinfo** hosts) {
  if (name != std::string("many")) {
    return __real_getaddrinfo(name, service, hints, hosts);
  }
  for (const char* address : {"127.0.0.4", "127.0.0.3", "127.0.0.2"}) {
    if (const int error = __real_getaddrinfo(address, service, hints, hosts)) {
      return error;
    }
    hosts = &(*hosts)->ai_next;
  }
  return 0;
}

namespace openr_host {
namespace {

using testing::HasSubstr;

const IPAddress kThisComputer(127, 0, 0, 1);

class DnsEndpointTest : public testing::Test {
 protected:
  DnsEndpointTest() {
    object_.on_answer = [this](ANTENVMSG message) {
      answers_.push_back(static_cast<const DNSEndpointHostMsg&>(*antEnvMsg::Receive(message)));
    };
    test_.boot();
    antEnvCreateEndpointMsg create(EndpointType_DNS, 16 * 1024);
    call(create);
    EXPECT_EQ(create.error, ANT_SUCCESS);
    endpoint_ = create.moduleRef;
  }

  template <typename Message>
  void call(Message& message) {
    test_.as(object_, [&] { EXPECT_EQ(message.Call(stack_, sizeof(message)), ANT_SUCCESS); });
  }
  template <typename Message>
  void post(Message message) {
    test_.as(object_,
             [&] { EXPECT_EQ(message.Send(stack_, object_.id(), TestObject::kSecond, sizeof(message)), ANT_SUCCESS); });
  }
  bool haveAnswers(std::size_t count) {
    return test_.runUntil([&] { return answers_.size() >= count; });
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  const antStackRef stack_{"IPStack"};
  antModuleRef endpoint_;
  std::vector<DNSEndpointHostMsg> answers_;
};

TEST_F(DnsEndpointTest, OneThatIsNotAskedDoesNothing) {
  test_.runPending();
  EXPECT_TRUE(answers_.empty());
}

// Page 35. Sony's sample DNSLookUp ends names with a dot, so that no domain is added.
TEST_F(DnsEndpointTest, FindsAHostByItsNameAgainAndAgain) {
  DNSEndpointGetServerAddressesMsg servers(endpoint_);
  call(servers);
  for (const std::string name : {"many", "localhost", "localhost.", "many."}) {
    const bool is_many = name[0] == 'm';
    answers_.clear();
    post(DNSEndpointGetHostByNameMsg(endpoint_, name.c_str()));
    ASSERT_TRUE(haveAnswers(1)) << name;
    EXPECT_EQ(answers_[0].error, DNS_SUCCESS) << name;
    EXPECT_EQ(answers_[0].n_address == 3, is_many);
    EXPECT_EQ(answers_[0].host_address, is_many ? IPAddress(127, 0, 0, 4) : kThisComputer) << "the first";
    EXPECT_STREQ(answers_[0].name, is_many ? "127.0.0.4" : "localhost") << "as the resolver names it";
    EXPECT_EQ(answers_[0].server_address, servers.nscount == 0 ? IPAddress() : servers.addrList[0]);
  }
}

TEST_F(DnsEndpointTest, FindsAHostByItsAddress) {
  post(DNSEndpointGetHostByAddrMsg(endpoint_, kThisComputer));
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(answers_[0].error, DNS_SUCCESS);
  EXPECT_EQ(answers_[0].n_address, 1);
  EXPECT_THAT(answers_[0].name, HasSubstr("localhost"));
  EXPECT_EQ(answers_[0].host_address, kThisComputer);
}

// Page 71. The name is too long for DNS, so no server is asked.
TEST_F(DnsEndpointTest, AnUnknownHostHasNoAddress) {
  post(DNSEndpointGetHostByNameMsg(endpoint_, std::string(80, 'x').c_str()));
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_NE(answers_[0].error, DNS_SUCCESS);
  EXPECT_EQ(answers_[0].n_address, 0);
}

// Pages 32 and 71.
TEST_F(DnsEndpointTest, ASecondQuestionIsBusyAndACloseEndsTheFirst) {
  post(DNSEndpointGetHostByNameMsg(endpoint_, "localhost"));
  post(DNSEndpointGetHostByNameMsg(endpoint_, "localhost"));
  DNSEndpointCloseMsg close(endpoint_);
  call(close);
  EXPECT_EQ(close.error, DNS_SUCCESS);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_[0].error, DNS_CONNECTION_BUSY);
  EXPECT_EQ(answers_[1].error, DNS_CONNECTION_CLOSED);
  post(DNSEndpointGetHostByNameMsg(endpoint_, "localhost"));
  ASSERT_TRUE(haveAnswers(3));
  EXPECT_EQ(answers_[2].error, DNS_OPERATION_INVALID);
  DNSEndpointGetServerAddressesMsg servers(endpoint_);
  call(servers);
  EXPECT_EQ(servers.error, DNS_OPERATION_INVALID);
}

// Pages 33 and 34.
TEST_F(DnsEndpointTest, TellsThisComputersServersAndDomain) {
  DNSEndpointGetServerAddressesMsg servers(endpoint_);
  call(servers);
  EXPECT_EQ(servers.error, DNS_SUCCESS);
  EXPECT_GE(servers.nscount, 0);
  EXPECT_LE(servers.nscount, MAXNS);
  for (int32 i = 0; i < servers.nscount; ++i) {
    EXPECT_NE(servers.addrList[i], IP_ADDR_ANY);
  }
  DNSEndpointGetDefaultDomainNameMsg domain(endpoint_);
  call(domain);
  EXPECT_EQ(domain.error, DNS_SUCCESS);
}

}  // namespace
}  // namespace openr_host
