#include <facemap/facemap.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iostream>
#include <memory>
#include <new>

#include "commands.h"
#include "contact_sheet.h"
#include "exit_codes.h"
#include "file_format.h"
#include "input_files.h"
#include "output.h"
#include "pending_files.h"
#include "progress_line.h"
#include "report.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

struct SheetArguments {
  std::vector<fs::path> paths;
  fs::path output;
  Size size{256, 256};
  int columns = 0;  ///< 0: as many as make the sheet about as wide as high
  int threads = 0;
  bool quiet = false;
};

bool is_model(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const char* const known[] = {".obj", ".gltf", ".glb", ".ply", ".stl"};
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

// The models of a folder and the folders in it, by name; a file is taken as it is.
void add_models(const fs::path& path, std::vector<fs::path>& models) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    models.push_back(path);
    return;
  }
  std::vector<fs::path> found;
  fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (is_model(entry->path()) && entry->is_regular_file(ignored)) found.push_back(entry->path());
  }
  if (error) throw Error(path.string() + ": " + error.message());
  std::sort(found.begin(), found.end());
  models.insert(models.end(), found.begin(), found.end());
}

int columns_for(std::size_t count, const Size& size) {
  int columns = 1;
  while (static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) * static_cast<std::size_t>(size.width) <
         count * static_cast<std::size_t>(size.height)) {
    ++columns;
  }
  return columns;
}

/// As facemap MODEL draws it; pixels that see the floor have no id.
Image picture_of(const fs::path& path, const SheetArguments& arguments) {
  ModelLimits limits;
  limits.threads = arguments.threads;
  Model model = load_model(path, limits);
  check_images_stay(arguments.output, model.images);
  const auto faces = static_cast<FaceId>(model.mesh.face_count());
  const Studio studio =
      make_studio(model.mesh, model.up.value_or(Vector(0, 1, 0)), arguments.size.width, arguments.size.height);
  append(model, make_ground(studio.ground, model, studio.view.up));
  const Scene scene(std::move(model), arguments.threads);
  Renderer::Options options;
  options.width = arguments.size.width;
  options.height = arguments.size.height;
  options.samples = 3;
  options.threads = arguments.threads;
  options.planes = {Plane::Id};
  options.background = studio.background;
  options.sky_up = studio.sky_up;
  options.sky_down = studio.sky_down;
  options.up = studio.view.up;
  Image picture = Renderer(scene, studio.view, studio.lights, options).render();
  for (FaceId& id : picture.ids) {
    if (id >= faces) id = kNoFace;
  }
  return picture;
}

int draw_sheet(const SheetArguments& arguments) {
  if (arguments.paths.empty()) throw UsageError("no model or folder is given");
  const FileFormat format = format_of(arguments.output);
  check_picture_output(arguments.output, {});
  std::vector<fs::path> models;
  for (const fs::path& path : arguments.paths) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw Error(path.string() + ": there is no such file or folder");
    add_models(path, models);
  }
  if (models.empty()) throw Error(arguments.paths[0].string() + ": no model is there");
  const int wanted = arguments.columns > 0 ? arguments.columns : columns_for(models.size(), arguments.size);
  const int columns = static_cast<int>(std::min(static_cast<std::size_t>(wanted), models.size()));
  ContactSheet sheet(models.size(), columns, arguments.size.width, arguments.size.height);

  set_report_style({arguments.quiet});
  ProgressLine line(models.size());
  std::ostream& list = is_standard_output(arguments.output) ? std::cerr : std::cout;
  std::size_t refused = 0, flagged = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    line.show(static_cast<double>(i) / static_cast<double>(models.size()), models[i].filename().c_str(), i);
    std::string verdict;
    try {
      const Image picture = picture_of(models[i], arguments);
      const PictureFlag flag = flag_of(picture);
      sheet.put(i, picture);
      if (flag != PictureFlag::None) verdict = std::string("  flagged: ") + name_of(flag);
      flagged += flag != PictureFlag::None;
    } catch (const Error& error) {
      sheet.cross_out(i);
      verdict = std::string("  refused: ") + error.what();
      ++refused;
    } catch (const std::bad_alloc&) {
      sheet.cross_out(i);
      verdict = "  refused: not enough memory";
      ++refused;
    }
    line.clear();
    list << i + 1 << "  " << models[i].string() << verdict << '\n' << std::flush;
  }
  write_output(arguments.output, encode_picture(sheet.image(), format, {}, {}, arguments.threads));
  list << models.size() - refused << " drawn, " << flagged << " of them flagged; " << refused << " refused\n";
  return flagged == 0 && refused < models.size() ? kDone : kFailed;
}

}  // namespace

Command sheet_command() {
  const auto arguments = std::make_shared<SheetArguments>();
  SheetArguments& a = *arguments;
  const auto path = [](const std::string& text) { return fs::path(text); };
  Command command;
  command.name = "sheet";
  command.summary = "Draw small pictures of many models on one sheet";
  command.text =
      "Draws each model as facemap MODEL does, numbers the pictures and lists them on standard output. A file that\n"
      "is refused is crossed out and listed with the reason. A picture in which hardly anything is seen, or nearly\n"
      "all of it is black or white, is flagged; then, or if nothing can be drawn, the exit code is 1.\n";
  command.options = {
      {"MODEL", "", "", "models, and folders with models: OBJ, glTF, PLY and STL files",
       [&a](const std::string& text) { a.paths.emplace_back(text); }, true},
      {"-o,--output", "FILE", "", "the sheet: .png, .jpg, .exr, .pfm or .npy; - writes PNG to standard output",
       into(a.output, path)},
      {"--size", "WxH", "256x256", "pixels of each picture", into(a.size, parse_size)},
      {"--columns", "N", "by their number", "pictures in a row",
       into(a.columns, [](const std::string& text) { return parse_whole_number(text, 1, 1000); })},
      {"--threads", "N", "0", "threads at work; 0: as many as there are processors", into(a.threads, parse_threads)},
      {"-q,--quiet", "", "", "no progress", [&a](const std::string&) { a.quiet = true; }},
  };
  command.examples = {
      {"facemap sheet models -o sheet.png", "everything in a folder"},
      {"facemap sheet old.obj new.obj -o both.png --size 512x512", "two models, side by side"},
  };
  command.run = [arguments] { return draw_sheet(*arguments); };
  return command;
}

}  // namespace facemap::program
