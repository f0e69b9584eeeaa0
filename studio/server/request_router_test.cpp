#include "studio/server/request_router.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "results/disk.h"
#include "results/sha256.h"

namespace pintle::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class StudioRequestRouter : public testing::Test {
 protected:
  StudioRequestRouter() {
    std::string name = (fs::temp_directory_path() / "pintle-router-XXXXXX").string();
    root_ = mkdtemp(name.data());
    for (const char* folder : {"pages/assets", "models/sub", "outside"}) fs::create_directories(root_ / folder);
    write("pages/index.html", "<p>studio");
    write("pages/assets/a.js", "1");
    write("models/a.toml", "format = 1\n");
    write("models/sub/b.json", "{}");
    write("models/notes.txt", "secret");
    write("models/.hidden.toml", "secret");
    write("outside/secret.toml", "secret");
    fs::create_symlink(root_ / "outside/secret.toml", root_ / "models/link.toml");
    fs::create_symlink(root_ / "outside", root_ / "models/way");
    fs::create_symlink(root_ / "outside", root_ / "pages/way");
    fs::create_symlink(root_ / "models/a.toml", root_ / "models/alias.toml");
    mkfifo((root_ / "models/pipe.toml").c_str(), 0600);
    router_ = std::make_unique<RequestRouter>(RouterSettings{root_ / "pages", root_ / "models", "a.toml", 4321, "t0ken"});
  }
  ~StudioRequestRouter() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) const { std::ofstream(root_ / path) << text; }
  std::string read(const std::string& path) const { return read_file(root_ / path); }

  static Request request(const std::string& method, const std::string& target, const std::string& body = "") {
    return {method, target, {{"host", "127.0.0.1:4321"}, {"x-pintle-token", "t0ken"}}, body};
  }
  Reply ask(const std::string& method, const std::string& target, const std::string& body = "") { return router_->answer(request(method, target, body)); }
  Json ask_json(const std::string& method, const std::string& target, const std::string& body = "") { return Json::parse(ask(method, target, body).body); }

  fs::path root_;
  std::unique_ptr<RequestRouter> router_;
};

TEST_F(StudioRequestRouter, GivesItsPagesWithAPolicy) {
  const Reply page = ask("GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<p>studio");
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  bool policy = false;
  for (const auto& [name, value] : page.headers) policy = policy || (name == "Content-Security-Policy" && value.find("default-src 'self'") != std::string::npos);
  EXPECT_TRUE(policy);
  EXPECT_EQ(ask("GET", "/assets/a.js?v=1").body, "1");
  EXPECT_EQ(ask("GET", "/assets").status, 404);
  EXPECT_EQ(ask("POST", "/").status, 405);
}

TEST_F(StudioRequestRouter, SendsCompressedPagesToBrowsersThatAcceptThem) {
  write("pages/index.html.br", "packed");
  const auto page = [&](const std::string& target, const std::string& accepted) {
    Request asked = request("GET", target);
    asked.headers.emplace("accept-encoding", accepted);
    const Reply reply = router_->answer(asked);
    EXPECT_EQ(reply.type, target == "/" ? "text/html; charset=utf-8" : "text/javascript; charset=utf-8");
    const bool labelled = std::find(reply.headers.begin(), reply.headers.end(), std::pair<std::string, std::string>("Content-Encoding", "br")) != reply.headers.end();
    return std::pair(reply.body, labelled);
  };
  for (const char* accepted : {"br", "gzip, deflate, br, zstd", "gzip,br;q=0.5"}) EXPECT_EQ(page("/", accepted), std::pair(std::string("packed"), true)) << accepted;
  for (const char* accepted : {"", "gzip", "brotli", "br;q=0", "gzip, br; q=0.0"}) EXPECT_EQ(page("/", accepted), std::pair(std::string("<p>studio"), false)) << accepted;
  EXPECT_EQ(page("/assets/a.js", "br"), std::pair(std::string("1"), false)) << "there is nothing compressed beside it";
}

TEST_F(StudioRequestRouter, NoPathLeadsOut) {
  for (const char* target : {"/../outside/secret.toml", "/%2e%2e/outside/secret.toml", "/..%2foutside/secret.toml", "/%2e%2e%2foutside%2fsecret.toml", "/..\\outside\\secret.toml",
                             "/..%5coutside%5csecret.toml", "/%252e%252e/outside/secret.toml", "//etc/passwd", "/assets/../../outside/secret.toml", "/assets//a.js",
                             "/way/secret.toml", "/index.html%00.js", "/%00", "/%", "/%2", "/%zz", "/.git/config", "/assets/%2e%2e/index.html", "/\x01", "etc/passwd", ""}) {
    const Reply reply = ask("GET", target);
    EXPECT_GE(reply.status, 400) << target;
    EXPECT_EQ(reply.body.find("secret"), std::string::npos) << target;
    EXPECT_EQ(reply.body.find("<p>"), std::string::npos) << target;
  }
  for (const char* path : {"..%2foutside%2fsecret.toml", "%2fetc%2fpasswd.toml", "link.toml", "way%2fsecret.toml", "way/secret.toml", ".hidden.toml", "notes.txt", "sub/../../outside/secret.toml",
                           "a.toml%00", "sub%5c..%5ca.toml", "", "pipe.toml", "sub", "c:a.toml"}) {
    const Reply reply = ask("GET", std::string("/api/model?path=") + path);
    EXPECT_GE(reply.status, 400) << path;
    EXPECT_EQ(reply.body.find("secret\""), std::string::npos) << path;
  }
}

TEST_F(StudioRequestRouter, AnswersItsOwnPageOnly) {
  const auto status = [&](const std::string& name, const std::string& value) {
    Request asked = request("GET", "/api/models");
    asked.headers.erase(name);
    if (!value.empty()) asked.headers.emplace(name, value);
    return router_->answer(asked).status;
  };
  EXPECT_EQ(status("host", "localhost:4321"), 200);
  for (const char* host : {"", "evil.example", "evil.example:4321", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:4321.evil.example", "127.0.0.2:4321", "[::1]:4321"}) EXPECT_EQ(status("host", host), 403) << host;
  EXPECT_EQ(status("origin", "http://127.0.0.1:4321"), 200);
  for (const char* origin : {"null", "http://evil.example", "http://127.0.0.1:80", "https://127.0.0.1:4321", "http://localhost:4321"}) EXPECT_EQ(status("origin", origin), 403) << origin;
  EXPECT_EQ(status("sec-fetch-site", "same-origin"), 200);
  EXPECT_EQ(status("sec-fetch-site", "cross-site"), 403);
  for (const char* token : {"", "t0keN", "t0ke", "t0kenn"}) EXPECT_EQ(status("x-pintle-token", token), 401) << token;
  Request twice = request("GET", "/api/models");
  twice.headers.emplace("host", "evil.example");
  EXPECT_EQ(router_->answer(twice).status, 403);
}

TEST_F(StudioRequestRouter, ATicketLetsInOnce) {
  RequestRouter router({root_ / "pages", root_ / "models", "", 4321, "t0ken", "t1cket"});
  EXPECT_EQ(router.answer(request("GET", "/enter/other")).status, 410);
  const Reply first = router.answer(request("GET", "/enter/t1cket"));
  EXPECT_EQ(first.status, 303);
  EXPECT_EQ(first.headers.at(0), (std::pair<std::string, std::string>("Location", "/#token=t0ken")));
  const Reply second = router.answer(request("GET", "/enter/t1cket"));
  EXPECT_EQ(second.status, 410);
  EXPECT_EQ(second.body.find("t0ken"), std::string::npos);
  EXPECT_EQ(ask("GET", "/enter/").status, 410);  // of a router without a ticket
}

TEST_F(StudioRequestRouter, ListsAndOpensModels) {
  const Json list = ask_json("GET", "/api/models");
  ASSERT_EQ(list["models"].size(), 2U);
  EXPECT_EQ(list["models"][0]["path"], "a.toml");
  EXPECT_EQ(list["models"][1]["path"], "sub/b.json");
  const Json model = ask_json("GET", "/api/model?path=sub%2Fb.json");
  EXPECT_EQ(model["text"], "{}");
  EXPECT_EQ(model["hash"], sha256("{}"));
  EXPECT_EQ(ask_json("GET", "/api/model?path=alias.toml")["text"], "format = 1\n");  // a link that stays inside
  EXPECT_EQ(ask("GET", "/api/model?path=none.toml").status, 404);
  EXPECT_EQ(ask_json("GET", "/api/about")["model"], "a.toml");
  write("models/bytes.toml", "a = \"\xff\xfe\"");
  EXPECT_EQ(ask("GET", "/api/model?path=bytes.toml").status, 422);
}

// Those that lie in the folder, below the model's own.
TEST_F(StudioRequestRouter, GivesTheFilesThatAModelNames) {
  write("models/sub/f.csv", "1,2\n");
  write("models/sub/tables.toml", "table.a.file = \"f.csv\"\ntable.b.file = \"none.csv\"\ntable.c.file = \"../../outside/secret.toml\"\ntable.d.file = \"../a.toml\"\ntable.e.file = \".hidden\"\ntable.f = 3\n");
  EXPECT_EQ(ask_json("GET", "/api/model?path=sub%2Ftables.toml")["files"], Json({{"f.csv", "1,2\n"}}));
  EXPECT_EQ(ask_json("GET", "/api/model?path=a.toml")["files"], Json::object());
}

TEST_F(StudioRequestRouter, SavesWhatHasNotBeenChangedByOthers) {
  const std::string hash = ask_json("GET", "/api/model?path=a.toml")["hash"];
  const auto save = [&](const std::string& path, const std::string& text, const Json& expected) {
    return ask("PUT", "/api/model", Json{{"path", path}, {"text", text}, {"expected", expected}}.dump());
  };
  const Reply saved = save("a.toml", "format = 1 # mine\n", hash);
  EXPECT_EQ(saved.status, 200);
  EXPECT_EQ(read("models/a.toml"), "format = 1 # mine\n");
  write("models/a.toml", "format = 1 # theirs\n");
  const Reply refused = save("a.toml", "format = 1 # mine again\n", Json::parse(saved.body)["hash"]);
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(Json::parse(refused.body)["text"], "format = 1 # theirs\n");
  EXPECT_EQ(read("models/a.toml"), "format = 1 # theirs\n");
  EXPECT_EQ(save("new.toml", "x", nullptr).status, 200);
  EXPECT_EQ(read("models/new.toml"), "x");
  EXPECT_EQ(save("new.toml", "y", nullptr).status, 409);
  EXPECT_EQ(save("gone.toml", "y", hash).status, 409);
  for (const char* path : {"../outside/secret.toml", "link.toml", "way/new.toml", "none/new.toml", "/tmp/x.toml", "a.sh", "pipe.toml", ".new.toml", "a\\b.toml"})
    for (const Json& expected : {Json(nullptr), Json(sha256("secret"))}) EXPECT_GE(save(path, "mine", expected).status, 400) << path;
  EXPECT_EQ(read("outside/secret.toml"), "secret");
  EXPECT_FALSE(fs::exists(root_ / "outside/new.toml"));
}

TEST_F(StudioRequestRouter, RefusesMalformedBodies) {
  for (const char* body : {"", "{", "[]", "null", "{}", R"({"path": 1})", R"({"path": "a.toml", "text": "x"})", R"({"path": "a.toml", "text": "x", "expected": 3})", "\xff"}) {
    EXPECT_EQ(ask("PUT", "/api/model", body).status, 400) << body;
    EXPECT_EQ(ask("POST", "/api/runs", std::string_view(body).starts_with("{\"path\"") ? "{}" : body).status, 400) << body;
  }
  for (const char* target : {"/api", "/api/", "/api/nothing", "/api/runs/1/other", "/api/model"}) EXPECT_GE(ask("GET", target).status, 400) << target;
  for (const char* target : {"/api/runs/x", "/api/runs/", "/api/runs/99999999999999999999"}) EXPECT_EQ(ask("GET", target).status, 400) << target;
  EXPECT_EQ(ask("GET", "/api/runs/7").status, 404);
  EXPECT_EQ(ask("DELETE", "/api/models").status, 405);
  EXPECT_EQ(ask("OPTIONS", "/api/models").status, 405);
}

Json body_for_run(const std::string& name, const std::string& duration) {
  return {{"text", read_file(std::string(PINTLE_SOURCE_DIR "/mechanisms/") + name)}, {"set", {{"simulate.duration", duration}, {"simulate.output_step", "10 ms"}}}};
}

TEST_F(StudioRequestRouter, RunsInTheBackground) {
  const Json started = ask_json("POST", "/api/runs", body_for_run("four_bar.toml", "0.1 s").dump());
  const std::string run = "/api/runs/" + std::to_string(started["id"].get<int>());
  for (int i = 0; i < 600 && ask_json("GET", run)["state"] == "running"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const Reply result = ask("GET", run + "/result");
  ASSERT_EQ(result.status, 200);
  EXPECT_NE(result.body.find(R"("outcome":"completed")"), std::string::npos);
  EXPECT_EQ(ask("DELETE", run).status, 200);
  EXPECT_EQ(ask("GET", run).status, 404);
}

TEST_F(StudioRequestRouter, ARunThatIsEndedKeepsWhatItHas) {
  const std::string body = body_for_run("andrews.toml", "100 s").dump();
  const std::string run = "/api/runs/" + std::to_string(ask_json("POST", "/api/runs", body)["id"].get<int>());
  EXPECT_EQ(ask("GET", run + "/result").status, 409);
  EXPECT_EQ(ask("POST", "/api/runs", body).status, 200);
  EXPECT_EQ(ask("POST", "/api/runs", body).status, 429);
  EXPECT_EQ(ask("DELETE", run).status, 200);
  for (int i = 0; i < 600 && ask_json("GET", run)["state"] == "running"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_NE(ask("GET", run + "/result").body.find(R"("outcome":"interrupted")"), std::string::npos);
}

}  // namespace
}  // namespace pintle::studio
