#include "scene/obj_chunks.h"

#include <facemap/error.h>
#include <facemap/obj.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <string>

#include "parallel/executor.h"
#include "support/random.h"

namespace facemap {
namespace {

OBJ::Limits with_threads(int threads) {
  OBJ::Limits limits;
  limits.threads = threads;
  return limits;
}

/// What reading gives, all of it, or what is wrong.
struct Reading {
  Mesh mesh;
  OBJ::Report report;
  std::string error;
};

Reading read(const std::string& text, const OBJ::Limits& limits) {
  Reading reading;
  try {
    OBJ obj = OBJ::parse(text, "text.obj", {}, limits);
    reading.report = obj.report();
    reading.mesh = std::move(obj).mesh();
  } catch (const LoadError& error) {
    reading.error = error.what();
  }
  return reading;
}

void expect_equal(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.error, b.error);
  EXPECT_TRUE(a.mesh.positions == b.mesh.positions);
  EXPECT_TRUE(a.mesh.normals == b.mesh.normals);
  EXPECT_TRUE(a.mesh.texture_coordinates == b.mesh.texture_coordinates);
  EXPECT_TRUE(a.mesh.colours == b.mesh.colours);
  EXPECT_TRUE(a.mesh.triangles == b.mesh.triangles);
  EXPECT_TRUE(a.mesh.normal_corners == b.mesh.normal_corners);
  EXPECT_TRUE(a.mesh.texture_corners == b.mesh.texture_corners);
  EXPECT_TRUE(a.mesh.polygons == b.mesh.polygons);
  EXPECT_TRUE(a.mesh.triangle_materials == b.mesh.triangle_materials);
  EXPECT_EQ(a.report.warnings, b.report.warnings);
  EXPECT_EQ(a.report.polygons, b.report.polygons);
  EXPECT_EQ(a.report.triangles, b.report.triangles);
  EXPECT_EQ(a.report.objects, b.report.objects);
  EXPECT_EQ(a.report.groups, b.report.groups);
  EXPECT_EQ(a.report.self_intersecting_polygons, b.report.self_intersecting_polygons);
  ASSERT_EQ(a.report.ignored.size(), b.report.ignored.size());
  for (std::size_t i = 0; i < a.report.ignored.size(); ++i) {
    EXPECT_EQ(a.report.ignored[i].statement, b.report.ignored[i].statement);
    EXPECT_EQ(a.report.ignored[i].count, b.report.ignored[i].count);
    EXPECT_EQ(a.report.ignored[i].first_line, b.report.ignored[i].first_line);
  }
}

/// Reads with one thread, line by line, and with more.
void expect_same_by_all(const std::string& text) {
  ASSERT_GE(text.size(), ObjChunks::kLeastBytes) << "not read in chunks";
  const Reading one = read(text, with_threads(1));
  for (const int threads : {2, 5}) expect_equal(one, read(text, with_threads(threads)));
}

/// A random OBJ text of some size. The flavour decides which statements are in it.
class TextMaker {
 public:
  TextMaker(std::uint64_t seed, bool counts_back) : random_(seed), counts_back_(counts_back) {}

  std::string make(std::size_t bytes) {
    for (int i = 0; i < 20; ++i) add_vertex();
    while (text_.size() < bytes) add_statement();
    return text_;
  }

 private:
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_.next() % count); }
  bool one_in(std::size_t count) { return below(count) == 0; }

  void add(const std::string& line) {
    if (one_in(40)) text_ += "  \t";
    text_ += line;
    if (one_in(50)) text_ += "  # as said";
    text_ += one_in(60) ? " \r\n" : "\n";
  }

  std::string number() {
    char digits[32];
    std::snprintf(digits, sizeof digits, one_in(9) ? "%.9g" : "%.3f", static_cast<double>(below(2000001)) / 1e6 - 1);
    return digits;
  }

  void add_vertex() {
    ++vertices_;
    add("v " + number() + " " + number() + " " + number());
  }

  std::string index(std::size_t count) {
    const std::size_t i = 1 + below(count);
    return counts_back_ ? "-" + std::to_string(i) : std::to_string(i);
  }

  void add_face() {
    const std::size_t corners = one_in(3) ? 4 : one_in(9) ? 5 + below(4) : 3;
    const bool has_texture = textures_ > 0 && one_in(2), has_normals = normals_ > 0 && one_in(2);
    std::string line = "f";
    for (std::size_t i = 0; i < corners; ++i) {
      line += " " + index(vertices_);
      if (has_texture) line += "/" + index(textures_);
      if (has_normals) line += (has_texture ? "/" : "//") + index(normals_);
    }
    add(line);
  }

  void add_statement() {
    const std::size_t kind = below(100);
    if (kind < 40) {
      add_vertex();
    } else if (kind < 90) {
      add_face();
    } else if (kind < 92) {
      ++textures_;
      add("vt " + number() + (one_in(3) ? "" : " " + number()) + (one_in(9) ? " 0 0" : ""));
    } else if (kind < 95) {
      ++normals_;
      add("vn " + number() + " " + number() + " " + number());
    } else {
      constexpr const char* kOthers[] = {"s 1",   "s off",    "usemtl red", "usemtl",  "g part", "o body",
                                         "l 1 2", "s spline", "# f 1 2 99", "trace 1", "",       "mtllib none.mtl"};
      add(kOthers[below(std::size(kOthers))]);
    }
  }

  Random random_;
  bool counts_back_;
  std::string text_;
  std::size_t vertices_ = 0, textures_ = 0, normals_ = 0;
};

constexpr std::size_t kBytes = ObjChunks::kLeastBytes + 5000;  // some chunks

TEST(ObjChunks, RandomTextsReadTheSame) {
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_by_all(TextMaker(seed, seed % 2 == 0).make(kBytes + 1000 * seed));
  }
}

TEST(ObjChunks, TextsWithoutOdditiesAreReadInChunks) {
  const Executor executor(2);
  std::string text = "\xEF\xBB\xBF# a model\n";
  int vertices = 0;
  while (text.size() < kBytes) {
    for (int i = 0; i < 5; ++i) text += "v " + std::to_string(vertices++) + " 0.5 -1e-3\n";
    text += "f -1 -2 -3\nf 1 2 3 4 # a quad\r\ns 1\nusemtl glass\n";
  }
  EXPECT_TRUE(ObjChunks().read(text, executor));
  EXPECT_TRUE(ObjChunks().read(text + "f 1 2 3", executor)) << "without a newline at the end";
  EXPECT_FALSE(ObjChunks().read(text + "f 1 2 \\\n3\n", executor));
  EXPECT_FALSE(ObjChunks().read(text + "f 1 2 " + std::to_string(vertices + 1) + "\n", executor));
  EXPECT_FALSE(ObjChunks().read(text + "v 1 2 x\n", executor));
}

TEST(ObjChunks, WhatIsOddIsSaidAsWithoutThem) {
  const std::string text = TextMaker(7, false).make(kBytes);
  const std::size_t middle = text.find('\n', text.size() / 2) + 1;
  for (const std::string& line : {std::string("f 1 2 9999999\n"),
                                  std::string("v 1 2 3 4 5\n"),
                                  std::string("v 1 2 3 0.5 0.5 2\n"),
                                  std::string("v 1 2\n"),
                                  std::string("f 1 2\n"),
                                  std::string("f 0 1 2\n"),
                                  std::string("f 1 2 3x\n"),
                                  std::string("f 1/ 2/ 3/\n"),
                                  std::string("f 1// 2// 3//\n"),
                                  std::string("f 1 2 4294967295\n"),
                                  std::string("f 1 2 99999999999999999999\n"),
                                  std::string("f -1 -2 -99999999\n"),
                                  std::string("f +1 2 3\n"),
                                  std::string("f 000000001 2 3\n"),
                                  std::string("vn 1 2 3 4\n"),
                                  std::string("vt\n"),
                                  std::string("vt 1 2 3 4\n"),
                                  std::string("v 1 2 \\\n3\n"),
                                  std::string("# not joined \\\nv 1 2 3\n"),
                                  std::string("v 1 2 3 # joined \\\nx\n"),
                                  std::string("g name \\\r\nof two lines\n"),
                                  std::string("v 1e39 2 3\n"),
                                  std::string("\0\n", 2),
                                  std::string("\xEF\xBB\xBFv 1 2 3\n"),
                                  std::string("\\\n"),
                                  std::string("\v\n"),
                                  std::string("v\n"),
                                  std::string("f\n"),
                                  std::string("vp 1\n")}) {
    SCOPED_TRACE(line);
    expect_same_by_all(text.substr(0, middle) + line + text.substr(middle));
    expect_same_by_all(text + line);
    expect_same_by_all(text + line.substr(0, line.size() - 1));
    expect_same_by_all(line + text);
  }
}

TEST(ObjChunks, LimitsHold) {
  const std::string text = TextMaker(3, true).make(kBytes);
  const Reading all = read(text, with_threads(2));
  OBJ::Limits limits = with_threads(2);
  limits.max_faces = all.mesh.face_count();
  EXPECT_EQ(read(text, limits).error, "");
  limits.max_faces -= 1;
  const std::string error = read(text, limits).error;
  EXPECT_NE(error.find("triangles"), std::string::npos) << error;
  limits.threads = 1;
  EXPECT_EQ(read(text, limits).error, error);
}

TEST(ObjChunks, LongLinesAndFilesOfOneLine) {
  expect_same_by_all("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#" + std::string(kBytes, ' ') + "\nf 3 2 1\n");
  expect_same_by_all("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3" + std::string(kBytes, ' '));
  expect_same_by_all(std::string(kBytes, '\n'));
  expect_same_by_all(std::string(kBytes, ' '));
  expect_same_by_all(std::string(kBytes, '\r'));
  expect_same_by_all("\xFE\xFF" + std::string(kBytes, '\n'));
  std::string ignored = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  while (ignored.size() < kBytes) ignored += "l 1 2\n";
  expect_same_by_all(ignored);
}

}  // namespace
}  // namespace facemap
