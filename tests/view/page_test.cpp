// SPDX-License-Identifier: Apache-2.0
#include "articula/view/view.hpp"

#include "catch.hpp"
#include "fake_port.hpp"
#include "scratch_folder.hpp"
#include "web_client.hpp"

#include <filesystem>
#include <string>

using articula::View;
using support::FakePort;
using support::get;

TEST_CASE("the files of the page are served with headers that keep other pages out") {
  const support::ScratchFolder scratch("view-page");
  scratch.write("page/index.html", "<html>");
  scratch.write("page/page.js", "plain");
  scratch.write("page/page.js.gz", "packed");
  scratch.write("secret", "secret");
  FakePort port;
  const View view(port, {.port = 0, .page_folder = (scratch.path() / "page").string()});
  const auto index = get(view.port(), "/");
  CHECK(index.body() == "<html>");
  CHECK(index["Content-Type"] == "text/html; charset=utf-8");
  CHECK(index["X-Content-Type-Options"] == "nosniff");
  CHECK(index["Referrer-Policy"] == "no-referrer");
  CHECK(index["Content-Security-Policy"].find("frame-ancestors 'none'") != std::string::npos);
  CHECK(get(view.port(), "/index.html?a=b").body() == "<html>");

  CHECK(get(view.port(), "/page.js").body() == "plain");
  const auto packed = get(view.port(), "/page.js", "Accept-Encoding: br, gzip\r\n");
  CHECK(packed.body() == "packed");
  CHECK(packed["Content-Encoding"] == "gzip");
  CHECK(packed["Content-Type"] == "text/javascript; charset=utf-8");

  support::RawClient client(view.port());
  client.send("HEAD /page.js HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto head = client.response(true);
  REQUIRE(head);
  CHECK((*head)["Content-Length"] == "5");
  client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");  // the same connection
  CHECK(client.response()->body() == "<html>");
}

TEST_CASE("no way leads out of the folders") {
  const support::ScratchFolder scratch("view-ways");
  scratch.write("page/index.html", "<html>");
  scratch.write("meshes/a.stl", "solid");
  scratch.write("secret", "secret");
  std::filesystem::create_symlink("../secret", scratch.path() / "page/index.html.gz");
  std::filesystem::create_symlink("../secret", scratch.path() / "meshes/a.stl.gz");
  FakePort port;
  const View view(port, {.port = 0,
                         .page_folder = (scratch.path() / "page").string(),
                         .mesh_folders = {{"arm", (scratch.path() / "meshes").string()}}});
  CHECK(get(view.port(), "/meshes/arm/a.stl").body() == "solid");
  CHECK(get(view.port(), "/meshes/arm/a%2estl").body() == "solid");
  // Also the compressed copy of a file must be in the folder.
  const char* const packed = "Accept-Encoding: gzip\r\n";
  CHECK(get(view.port(), "/", packed).body() == "<html>");
  CHECK(get(view.port(), "/meshes/arm/a.stl", packed).body() == "solid");
  for (const char* target :
       {"/../secret", "/%2e%2e/secret", "/..%2fsecret", "/%2e%2e%2fsecret", "//etc/passwd",
        "/meshes/arm/../../secret", "/meshes/arm/%2e%2e/secret", "/meshes/arm/..%5csecret",
        "/meshes/../page/index.html", "/meshes/arm/", "/meshes/arm", "/meshes/leg/a.stl",
        "/meshes/arm//etc/passwd", "/meshes/arm/a.stl%00.html", "/meshes//arm/a.stl", "/nothing"}) {
    INFO(target);
    CHECK(get(view.port(), target).result_int() == 404);
  }
}

TEST_CASE("a folder without a page is refused") {
  const support::ScratchFolder scratch("view-none");
  FakePort port;
  CHECK_THROWS_WITH(View(port, {.port = 0, .page_folder = scratch.path().string()}),
                    "view: ViewOptions::page_folder, " + scratch.path().string() +
                        ", has no index.html; leave it empty for the page of the build");
}
