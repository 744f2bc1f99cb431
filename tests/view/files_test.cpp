// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/files.hpp"

#include "catch.hpp"
#include "scratch_folder.hpp"

#include <string>

using namespace articula::view;
namespace fs = std::filesystem;

TEST_CASE("files of a folder are served, and nothing else") {
  const support::ScratchFolder scratch("view-files");
  const fs::path root = scratch.path() / "root";
  scratch.write("root/a.stl", "mesh");
  scratch.write("root/deep/er/b.stl", "deeper");
  scratch.write("root/.hidden", "hidden");
  scratch.write("secret", "secret");
  fs::create_symlink("../secret", root / "link");
  fs::create_directory_symlink("..", root / "up");
  fs::create_symlink("a.stl", root / "inner");

  REQUIRE(file_in(root, "a.stl"));
  CHECK(*contents_of(*file_in(root, "a.stl")) == "mesh");
  CHECK(*contents_of(*file_in(root, "deep/er/b.stl")) == "deeper");
  CHECK(*contents_of(*file_in(root, "inner")) == "mesh");  // stays in the folder
  for (const std::string& name :
       {std::string("../secret"), std::string("/etc/passwd"), std::string("deep/../../secret"),
        std::string("./a.stl"), std::string("deep//er/b.stl"), std::string("link"),
        std::string("up/secret"), std::string(".hidden"), std::string("deep"), std::string(""),
        std::string("..\\secret"), std::string("a.stl\0", 6), std::string("a.stl/"),
        std::string("missing"), std::string("C:a.stl"), std::string(5000, 'a')}) {
    INFO(name);
    CHECK_FALSE(file_in(root, name));
  }
  CHECK_FALSE(file_in("", "a.stl"));
  CHECK_FALSE(file_in(scratch.path() / "no such folder", "a.stl"));
}

TEST_CASE("meshes come from the folder of their package") {
  const support::ScratchFolder scratch("view-meshes");
  scratch.write("one/a.stl", "1");
  scratch.write("two/a.stl", "2");
  articula::ViewOptions options;
  options.mesh_folders = {{"arm", (scratch.path() / "one").string()},
                          {"hand", (scratch.path() / "two").string()}};
  CHECK(*contents_of(*mesh_file(options, "arm/a.stl")) == "1");
  CHECK(*contents_of(*mesh_file(options, "hand/a.stl")) == "2");
  for (const char* name :
       {"", "arm", "arm/", "leg/a.stl", "/arm/a.stl", "arm/../two/a.stl", "../one"}) {
    INFO(name);
    CHECK_FALSE(mesh_file(options, name));
  }
}

TEST_CASE("a file that is too large, or gone, has no contents") {
  const support::ScratchFolder scratch("view-large");
  scratch.write("large", "");
  fs::resize_file(scratch.path() / "large", file_limit + 1);  // sparse
  CHECK(contents_of(scratch.path() / "large") == nullptr);
  CHECK(contents_of(scratch.path() / "none") == nullptr);
}

TEST_CASE("media types follow the ends of names") {
  CHECK(media_type_of("a.html") == "text/html; charset=utf-8");
  CHECK(media_type_of("a.STL") == "model/stl");
  CHECK(media_type_of("a") == "application/octet-stream");
}
