#include "scene/texture_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/image_table.h"

namespace facemap {
namespace {

namespace fs = std::filesystem;
using Outcome = TextureFiles::Outcome;

// A folder of a model with textures in it and one beside it; gone with the test.
class TextureFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("facemap-textures-" + std::to_string(::getpid()));
    model_ = root_ / "model";
    for (const char* name : {"model/Wood 01.PNG", "model/maps/Bump.jpg", "model/mtl/deep.png", "secret.png"}) {
      fs::create_directories((root_ / name).parent_path());
      std::ofstream(root_ / name) << "x";
    }
    fs::create_symlink("../secret.png", model_ / "link.png");
  }
  void TearDown() override { fs::remove_all(root_); }

  // The file found from the model's folder, relative to it.
  std::string found(const std::string& name, bool allow_outside = false) const {
    const TextureFiles::Found file = TextureFiles(model_, allow_outside).find(model_, name);
    if (file.outcome != Outcome::Found) return file.outcome == Outcome::Missing ? "missing" : "outside";
    return file.path.lexically_normal().lexically_relative(model_).string();
  }

  fs::path root_, model_;
};

TEST_F(TextureFilesTest, NamesAreFoundAsPeopleHaveThem) {
  EXPECT_EQ(found("Wood 01.PNG"), "Wood 01.PNG");
  EXPECT_EQ(found("wood 01.png"), "Wood 01.PNG");
  EXPECT_EQ(found(" \"Wood 01.PNG\"\t"), "Wood 01.PNG");
  EXPECT_EQ(found("MAPS\\bump.JPG"), "maps/Bump.jpg");
  EXPECT_EQ(found(".\\maps\\Bump.jpg"), "maps/Bump.jpg");
  EXPECT_EQ(found("C:\\Users\\me\\Desktop\\wood 01.png"), "Wood 01.PNG") << "the last part";
  EXPECT_EQ(found("/home/me/Wood 01.PNG"), "Wood 01.PNG");
  EXPECT_EQ(found("elsewhere/Wood 01.PNG"), "Wood 01.PNG");
  EXPECT_EQ(found("maps"), "missing") << "a folder";
  EXPECT_EQ(found("none.png"), "missing");
  EXPECT_EQ(found(""), "missing");
  EXPECT_EQ(found(std::string("a\0b", 3)), "missing");
}

TEST_F(TextureFilesTest, FilesOutsideTheModelsFolderAreNotOpened) {
  const std::string secret = (root_ / "secret.png").string();
  for (const std::string& name : {std::string("../secret.png"), std::string("maps/../../secret.png"), secret}) {
    EXPECT_EQ(found(name), "outside") << name;
    EXPECT_EQ(found(name, true), "../secret.png") << name;
  }
  EXPECT_EQ(found("link.png"), "outside") << "a symbolic link that leads out";
  EXPECT_EQ(found("link.png", true), "link.png");
  EXPECT_EQ(found("../model/Wood 01.PNG"), "Wood 01.PNG") << "and in again";
}

TEST_F(TextureFilesTest, NamesStartFromTheFolderThatNamesThem) {
  TextureFiles files(model_, false);
  EXPECT_EQ(files.find(model_ / "mtl", "deep.png").outcome, Outcome::Found);
  EXPECT_EQ(files.find(model_ / "mtl", "../maps/bump.jpg").outcome, Outcome::Found) << "within the model's folder";
  EXPECT_EQ(files.find(model_ / "mtl", "../../secret.png").outcome, Outcome::Outside);
}

TEST_F(TextureFilesTest, ImagesAreNumberedOnceAndMissingOnesAreAWarning) {
  ImageTable table(model_, false);
  ObjWarnings warnings("a.mtl");
  EXPECT_EQ(table.add(model_, "wood 01.png", 1, warnings), 0u);
  EXPECT_EQ(table.add(model_, "maps/Bump.jpg", 2, warnings), 1u);
  EXPECT_EQ(table.add(model_, "Wood 01.PNG", 3, warnings), 0u);
  EXPECT_EQ(table.add(model_, "none.png", 4, warnings), kNoIndex);
  EXPECT_EQ(table.add(model_, "../secret.png", 5, warnings), kNoIndex);
  std::vector<std::string> texts;
  warnings.append_to(texts);
  EXPECT_EQ(texts, (std::vector<std::string>{"a.mtl:4: texture not found: none.png",
                                             "a.mtl:5: texture lies outside the model's folder: ../secret.png"}));
}

}  // namespace
}  // namespace facemap
