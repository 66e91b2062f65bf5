#include <facemap/error.h>
#include <facemap/generators.h>

#include <charconv>
#include <fstream>

namespace facemap {
namespace {

/// Text gathered in blocks before it goes to the stream.
class TextBuffer {
 public:
  explicit TextBuffer(std::ostream& out) : out_(out) { text_.reserve(kBlock + kSlack); }

  TextBuffer& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  TextBuffer& operator<<(char c) {
    text_ += c;
    return *this;
  }
  TextBuffer& operator<<(float value) { return number(value); }
  TextBuffer& operator<<(std::uint32_t value) { return number(value); }

  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  void end_line() {
    text_ += '\n';
    if (text_.size() >= kBlock) flush();
  }

 private:
  static constexpr std::size_t kBlock = 1 << 16, kSlack = 1 << 10;

  template <class Number>
  TextBuffer& number(Number value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text_.append(digits, end);
    return *this;
  }

  std::ostream& out_;
  std::string text_;
};

void append_number(std::string& text, float value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_numbers(std::string& text, const Vector& v) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) text += ',';
    append_number(text, v[i]);
  }
}

void write_faces(TextBuffer& text, const GeneratedScene& scene) {
  constexpr int kNone = -1;
  int group = kNone;
  std::size_t part = 0;
  for (std::size_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    if (part < scene.parts.size() && scene.parts[part].first_face == i) {
      text << "o " << scene.parts[part++].name;
      text.end_line();
    }
    if (group != scene.smoothing_groups[i]) {
      group = scene.smoothing_groups[i];
      text << "s ";
      if (group == 0) {
        text << "off";
      } else {
        text << static_cast<std::uint32_t>(group);
      }
      text.end_line();
    }
    const Corners& t = scene.mesh.triangles[i];
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1;
    text.end_line();
  }
}

}  // namespace

std::string view_flags(const GeneratedScene& scene) {
  std::string text = "--camera ";
  append_numbers(text, scene.camera_position);
  text += " --look-at ";
  append_numbers(text, scene.look_at);
  text += " --up ";
  append_numbers(text, scene.up);
  text += " --field-angle ";
  append_number(text, scene.field_angle_deg);
  for (const GeneratedScene::Light& light : scene.lights) {
    text += " --light ";
    append_numbers(text, light.position);
    text += ',';
    append_numbers(text, light.color * light.intensity);
  }
  return text;
}

void write_obj(std::ostream& out, const GeneratedScene& scene, std::string_view file_name) {
  TextBuffer text(out);
  text << "# facemap render " << file_name << ' ' << view_flags(scene);
  text.end_line();
  for (const Vector& p : scene.mesh.positions) {
    text << "v " << p.x << ' ' << p.y << ' ' << p.z;
    text.end_line();
  }
  write_faces(text, scene);
  text.flush();
  out.flush();
  if (!out) throw Error(std::string(file_name) + ": cannot write");
}

void write_obj(const std::filesystem::path& path, const GeneratedScene& scene) {
  std::ofstream out(path, std::ios::binary);
  if (!out) throw Error(path.string() + ": cannot open for writing");
  write_obj(out, scene, path.filename().string());
}

}  // namespace facemap
