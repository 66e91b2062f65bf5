// The question of binding_overhead.py in C++ alone, without threads or interruptions of the module's own.
#include <facemap/scene.h>
#include <facemap/viewpoint.h>
#include <pybind11/numpy.h>

#include <array>
#include <chrono>
#include <cstring>
#include <vector>

namespace {

namespace py = pybind11;
using facemap::Vector;
template <typename Number>
using Rows = py::array_t<Number, py::array::c_style>;

facemap::Mesh mesh_of(const Rows<float>& vertices, const Rows<std::uint32_t>& faces) {
  facemap::Mesh mesh;
  mesh.positions.resize(static_cast<std::size_t>(vertices.shape(0)));
  mesh.triangles.resize(static_cast<std::size_t>(faces.shape(0)));
  std::memcpy(mesh.positions.data(), vertices.data(), static_cast<std::size_t>(vertices.nbytes()));
  std::memcpy(mesh.triangles.data(), faces.data(), static_cast<std::size_t>(faces.nbytes()));
  return mesh;
}

class Question {
 public:
  Question(const Rows<float>& vertices, const Rows<std::uint32_t>& faces, const Rows<float>& points, float x, float y,
           float z, int threads)
      : scene_(mesh_of(vertices, faces)),
        view_(scene_, Vector(x, y, z), {threads}),
        points_(static_cast<std::size_t>(points.shape(0))),
        answers_(points_.size()) {
    std::memcpy(points_.data(), points.data(), static_cast<std::size_t>(points.nbytes()));
    view_.prepare();
  }

  /// Seconds that the answer takes.
  double ask() {
    const auto begin = std::chrono::steady_clock::now();
    view_.visible({points_}, answers_);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  std::size_t seen() const {
    std::size_t count = 0;
    for (const std::uint8_t answer : answers_) count += answer;
    return count;
  }

 private:
  facemap::Scene scene_;
  facemap::Viewpoint view_;
  std::vector<Vector> points_;
  std::vector<std::uint8_t> answers_;
};

}  // namespace

PYBIND11_MODULE(binding, module) {
  py::class_<Question>(module, "Question")
      .def(py::init<const Rows<float>&, const Rows<std::uint32_t>&, const Rows<float>&, float, float, float, int>())
      .def("ask", &Question::ask)
      .def("seen", &Question::seen);
}
