#include "web/gate.h"

#include <gmock/gmock.h>

#include <boost/beast/http.hpp>
#include <set>
#include <stdexcept>

namespace aibo_driver::web {
namespace {

namespace http = boost::beast::http;

// What a browser sends when it loads the page, or opens its WebSocket.
Request page(const std::string& host, const std::string& target = "/", const std::string& origin = "",
             const std::string& cookie = "") {
  Request request(http::verb::get, target, 11);
  request.set(http::field::host, host);
  if (!origin.empty()) {
    request.set(http::field::origin, origin);
  }
  request.set(http::field::cookie, cookie);
  return request;
}

Request socket(const std::string& host, const std::string& origin, const std::string& cookie = "",
               const std::string& target = "/ws") {
  Request request = page(host, target, origin, cookie);
  request.set(http::field::connection, "Upgrade");
  request.set(http::field::upgrade, "websocket");
  return request;
}

struct GateRow {
  const char* what;
  Request request;
  unsigned status;
};

void expectVerdicts(const Gate& gate, const std::vector<GateRow>& rows) {
  for (const GateRow& row : rows) {
    const Verdict verdict = gate.judge(row.request);
    EXPECT_EQ(verdict.status, row.status) << row.what << ": " << verdict.text;
    EXPECT_EQ(verdict.text.empty(), row.status < 400) << row.what;
  }
}

TEST(GateOfThisComputer, LetsInOnlyThePageFromHere) {
  Request post = page("127.0.0.1:8080");
  post.method(http::verb::post);
  expectVerdicts(Gate("127.0.0.1", 8080),
                 {
                     {"the page", page("127.0.0.1:8080"), 200},
                     {"by name", page("LocalHost:8080"), 200},
                     {"its WebSocket", socket("127.0.0.1:8080", "http://127.0.0.1:8080"), 101},
                     {"by name", socket("localhost:8080", "http://localhost:8080"), 101},
                     {"a name that a stranger lets point here", page("evil.example:8080"), 403},
                     {"the same", socket("evil.example:8080", "http://evil.example:8080"), 403},
                     {"another port", page("127.0.0.1:80"), 403},
                     {"no port", page("127.0.0.1"), 403},
                     {"no host", page(""), 403},
                     {"a stranger's page", socket("127.0.0.1:8080", "http://evil.example"), 403},
                     {"a page of another server here", socket("127.0.0.1:8080", "http://127.0.0.1:3000"), 403},
                     {"a page by https", socket("127.0.0.1:8080", "https://127.0.0.1:8080"), 403},
                     {"a file, or a frame without rights", socket("127.0.0.1:8080", "null"), 403},
                     {"no browser", socket("127.0.0.1:8080", ""), 403},
                     {"a stranger's page asks for the page", page("127.0.0.1:8080", "/", "http://evil.example"), 403},
                     {"another method", post, 405},
                     {"another file", page("127.0.0.1:8080", "/etc/passwd"), 404},
                     {"the WebSocket as a page", page("127.0.0.1:8080", "/ws"), 404},
                     {"the page as a WebSocket", socket("127.0.0.1:8080", "http://127.0.0.1:8080", "", "/"), 404},
                 });
}

class GateToTheNetwork : public ::testing::Test {
 protected:
  const Gate gate{"192.168.1.5", 8080};
  const std::string host = "192.168.1.5:8080";
  const std::string origin = "http://" + host;
  const std::string link = gate.link().substr(origin.size());
  const std::string code = link.substr(std::string("/?code=").size());
  const std::string cookie = "aibo_code_8080=" + code;
};

TEST_F(GateToTheNetwork, NeedsTheCode) {
  std::string almost = cookie;
  almost.back() = almost.back() == '0' ? '1' : '0';
  const std::string shorter(link, 0, link.size() - 1);
  expectVerdicts(gate, {
                           {"the link", page(host, link), 200},
                           {"the cookie", page(host, "/", "", cookie), 200},
                           {"the cookie for the WebSocket", socket(host, origin, cookie), 101},
                           {"beside others", socket(host, origin, "a=b; " + cookie + "; c=d"), 101},
                           {"no code", page(host), 403},
                           {"no code for the WebSocket", socket(host, origin), 403},
                           {"an empty code", page(host, "/?code="), 403},
                           {"a digit is wrong", socket(host, origin, almost), 403},
                           {"a digit lacks", page(host, shorter), 403},
                           {"a digit too many", socket(host, origin, cookie + "0"), 403},
                           {"the cookie of another port", socket(host, origin, "aibo_code_80=" + code), 403},
                           {"a cookie that ends like it", socket(host, origin, "x" + cookie), 403},
                           {"a stranger's page with the cookie", socket(host, "http://evil.example", cookie), 403},
                           {"this computer is no exception", page("127.0.0.1:8080", "/", "", cookie), 403},
                       });
}

TEST_F(GateToTheNetwork, GivesTheCodeAsACookieThatNoScriptAndNoOtherPageGets) {
  const std::string given = gate.judge(page(host, link)).set_cookie;
  EXPECT_EQ(given.find(cookie + ";"), 0u) << given;
  EXPECT_THAT(given, testing::AllOf(testing::HasSubstr("HttpOnly"), testing::HasSubstr("SameSite=Strict")));
  EXPECT_EQ(gate.judge(page(host, "/?code=1")).set_cookie, "");
}

TEST_F(GateToTheNetwork, HasANewCodeEachTime) {
  std::set<std::string> links;
  for (int i = 0; i < 100; ++i) {
    links.insert(Gate("192.168.1.5", 8080).link());
  }
  EXPECT_EQ(links.size(), 100u);
  EXPECT_THAT(code, testing::MatchesRegex("[-0-9a-f]{36}"));
}

TEST(Gate, NamesItsLink) {
  EXPECT_EQ(Gate("127.0.0.1", 8080).link(), "http://127.0.0.1:8080/");
  EXPECT_EQ(Gate("::1", 8080).link(), "http://[::1]:8080/");
  EXPECT_THAT(Gate("192.168.1.5", 80).link(), testing::StartsWith("http://192.168.1.5/?code="));
}

TEST(Gate, RefusesWhatIsNoAddressOfAPage) {
  for (const char* address : {"0.0.0.0", "::", "den.local", ""}) {
    EXPECT_THROW(Gate(address, 8080), std::invalid_argument) << address;
  }
}

}  // namespace
}  // namespace aibo_driver::web
