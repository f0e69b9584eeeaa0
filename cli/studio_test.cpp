// pintle studio over real sockets: requests from outside its page, and that it survives them.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace pintle::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kProgram = fs::path(PINTLE_BINARY).parent_path() / "pintle-studio";

/// A new studio in a new folder, at a free port.
class StudioServer : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kProgram)) GTEST_SKIP() << "built without cpp-httplib";
    std::string name = (fs::temp_directory_path() / "pintle-studio-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "a.toml") << "format = 1\n";
    fs::create_directory(folder_ / ".pages");
    std::ofstream(folder_ / ".pages/index.html") << "<p>studio";
    start();
  }
  void TearDown() override {
    if (child_ <= 0) return;
    kill(child_, SIGINT);
    int status = -1;
    waitpid(child_, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    fs::remove_all(folder_);
  }

  void start() {
    const fs::path said = folder_ / "said.txt";
    child_ = fork();
    ASSERT_GE(child_, 0);
    if (child_ == 0) {
      signal(SIGINT, SIG_DFL);  // a shell that starts the tests in the background makes all of them ignore it
      if (chdir(folder_.c_str()) != 0 || freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      execl(kProgram.c_str(), "pintle", "studio", "a.toml", "--no-browser", "--port", "0", "--pages", ".pages", static_cast<char*>(nullptr));
      _exit(1);
    }
    for (int i = 0; i < 200 && port_ == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
      std::string text;
      std::getline(std::ifstream(said), text);
      const std::size_t port = text.find("127.0.0.1:"), token = text.find("#token=");
      if (port == std::string::npos || token == std::string::npos) continue;
      port_ = std::stoi(text.substr(port + 10));
      token_ = text.substr(token + 7);
    }
    ASSERT_GT(port_, 0);
  }

  int connect_to(const char* address) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port_));
    inet_pton(AF_INET, address, &at.sin_addr);
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0) return socket;
    close(socket);
    return -1;
  }

  /// Sends raw bytes, and returns the answer up to the closing of the connection.
  /// `and_no_more`: nothing will follow, so the server need not wait for the rest.
  std::string say(const std::string& bytes, bool and_no_more = false) const {
    const int socket = connect_to("127.0.0.1");
    if (socket < 0) return "no connection";
    const timeval patience{10, 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t n = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) break;
      sent += static_cast<std::size_t>(n);
    }
    if (and_no_more) shutdown(socket, SHUT_WR);
    std::string answer;
    char buffer[4096];
    for (ssize_t n = 0; (n = recv(socket, buffer, sizeof buffer, 0)) > 0;) answer.append(buffer, static_cast<std::size_t>(n));
    close(socket);
    return answer;
  }

  std::string host() const { return "Host: 127.0.0.1:" + std::to_string(port_) + "\r\n"; }
  std::string ask(const std::string& line, const std::string& headers = "", const std::string& body = "") const {
    const std::string length = body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n";
    return say(line + " HTTP/1.1\r\n" + host() + "Connection: close\r\nX-Pintle-Token: " + token_ + "\r\n" + headers + length + "\r\n" + body);
  }
  static int status(const std::string& answer) { return answer.size() > 12 && answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0; }
  void expect_alive() const { EXPECT_EQ(status(ask("GET /api/about")), 200); }

  fs::path folder_;
  pid_t child_ = -1;
  int port_ = 0;
  std::string token_;
};

TEST_F(StudioServer, ServesItsPageAndItsModels) {
  EXPECT_EQ(status(ask("GET /")), 200);
  EXPECT_NE(ask("GET /api/model?path=a.toml").find("format = 1"), std::string::npos);
  EXPECT_EQ(status(ask("PUT /api/model", "", R"({"path": "b.toml", "text": "format = 1\n", "expected": null})")), 200);
  EXPECT_TRUE(fs::exists(folder_ / "b.toml"));
}

TEST_F(StudioServer, SendsCompressedPagesAsTheyAre) {
  const std::string packed = "compressed elsewhere: " + std::string(5000, 'x');  // long enough that compressing it again would be worthwhile
  std::ofstream(folder_ / ".pages/index.html.br") << packed;
  const std::string answer = ask("GET /", "Accept-Encoding: gzip, br\r\n");
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find("Content-Encoding: br\r\n"), std::string::npos) << answer.substr(0, 1000);
  EXPECT_TRUE(answer.ends_with("\r\n\r\n" + packed));
  EXPECT_TRUE(ask("GET /").ends_with("\r\n\r\n<p>studio"));
  EXPECT_EQ(ask("HEAD /", "Accept-Encoding: br\r\n").find(packed), std::string::npos);
}

TEST_F(StudioServer, IsNotThereForOtherMachines) {
  EXPECT_EQ(connect_to("127.0.0.2"), -1);  // listens at 127.0.0.1 alone, not at every address
}

TEST_F(StudioServer, KnowsNoOtherHostAndNoOtherOrigin) {
  const std::string token = "Connection: close\r\nX-Pintle-Token: " + token_ + "\r\n";
  EXPECT_EQ(status(say("GET /api/about HTTP/1.1\r\nHost: rebound.example:" + std::to_string(port_) + "\r\n" + token + "\r\n")), 403);
  EXPECT_EQ(status(say("GET /api/about HTTP/1.1\r\n" + token + "\r\n")), 403);
  EXPECT_EQ(status(say("GET / HTTP/1.1\r\nHost: rebound.example\r\nConnection: close\r\n\r\n")), 403);
  EXPECT_EQ(status(ask("GET /api/about", "Origin: http://other.example\r\n")), 403);
  EXPECT_EQ(status(ask("GET /api/about", "Origin: null\r\n")), 403);
  EXPECT_EQ(status(say("GET /api/about HTTP/1.1\r\n" + host() + "Connection: close\r\n\r\n")), 401);
  expect_alive();
}

TEST_F(StudioServer, ServesNothingOutsideItsFolder) {
  std::ofstream(folder_.parent_path() / "pintle-outside.toml") << "secret";
  fs::create_symlink(folder_.parent_path() / "pintle-outside.toml", folder_ / "way.toml");
  for (const char* target : {"/../../../../etc/passwd", "/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2f..%2fetc%2fpasswd", "/%252e%252e/etc/passwd", "//etc/passwd", "/\\..\\..\\etc\\passwd",
                             "/etc/passwd%00.html", "/.", "/..", "/api/../../etc/passwd", "/api/model?path=../pintle-outside.toml", "/api/model?path=..%2fpintle-outside.toml",
                             "/api/model?path=way.toml", "/api/model?path=%2ftmp%2fpintle-outside.toml", "/api/model?path=a.toml%00", "http://127.0.0.1/etc/passwd"}) {
    const std::string answer = ask(std::string("GET ") + target);
    EXPECT_GE(status(answer), 400) << target;
    EXPECT_EQ(answer.find("secret"), std::string::npos) << target;
    EXPECT_EQ(answer.find("root:"), std::string::npos) << target;
  }
  fs::remove(folder_.parent_path() / "pintle-outside.toml");
  expect_alive();
}

TEST_F(StudioServer, OutlivesMalformedAndOversizedRequests) {
  const std::string large(200'000, 'a');
  say("", true);
  for (const std::string& bytes : {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"), std::string("\0\0\0\0\r\n\r\n", 8), std::string("FETCH / HTTP/1.1\r\n\r\n"),
                                   "GET /" + large + " HTTP/1.1\r\n" + host() + "\r\n", "GET / HTTP/1.1\r\n" + host() + "X: " + large + "\r\n\r\n",
                                   "no colon\r\n" + host() + "\r\n", std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc", 9) + "\r\n\r\n"})
    EXPECT_NE(status(say(bytes, true)), 200);
  EXPECT_EQ(status(say("PUT /api/model HTTP/1.1\r\n" + host() + "Connection: close\r\nX-Pintle-Token: " + token_ + "\r\nContent-Length: 99999999999999\r\n\r\n")), 413);
  EXPECT_NE(status(say("PUT /api/model HTTP/1.1\r\n" + host() + "Connection: close\r\nX-Pintle-Token: " + token_ + "\r\nContent-Length: -5\r\n\r\n{}", true)), 200);
  EXPECT_EQ(status(ask("PUT /api/model", "", "{\"path\"")), 400);
  EXPECT_EQ(status(ask("PUT /api/model", "", std::string(100'000, '['))), 400);
  EXPECT_EQ(status(ask("OPTIONS /api/model")), 405);
  expect_alive();
}

}  // namespace
}  // namespace pintle::cli
