#include <array>
#include <string_view>

#include "math/elementary.h"
#include "scene/generators/chess_pieces.h"
#include "scene/generators/scene_builder.h"

namespace facemap::generators {
namespace {

constexpr int kFiles = 8;
constexpr double kEdge = kFiles / 2.0;
constexpr double kBevel = 0.05;
constexpr double kTop = 0.03;      // the face of a square above the grooves between squares
constexpr double kFelt = 0.004;    // what a piece stands above its square
constexpr int kPits = 8;           // pits along a side of a dark square
constexpr double kPitDepth = 1.8;  // in widths of a pit

DVector on_board(double file, double rank) { return {file - kEdge, 0, kEdge - rank}; }

// The four corners of the square whose lower left corner is (file, rank), counter-clockwise seen from above.
std::array<std::uint32_t, 4> square_corners(int file, int rank) {
  const auto at = [](int f, int r) { return static_cast<std::uint32_t>(r * (kFiles + 1) + f); };
  return {at(file, rank), at(file + 1, rank), at(file + 1, rank + 1), at(file, rank + 1)};
}

void add_light_square(Solid& board, int file, int rank) {
  const auto corners = square_corners(file, rank);
  Ring outer(corners.begin(), corners.end()), inner;
  for (int i = 0; i < 4; ++i) {
    const double f = file + (i == 1 || i == 2 ? 1 - kBevel : kBevel), r = rank + (i >= 2 ? 1 - kBevel : kBevel);
    inner.push_back(board.add_point(on_board(f, r) + DVector(0, kTop, 0)));
  }
  bridge(board, outer, inner, 0);
  board.add_quad(inner[0], inner[1], inner[2], inner[3], 0);
}

// A dark square is a field of pits, in which most light falls on what the eye does not see.
void add_dark_square(Solid& board, int file, int rank) {
  const auto corners = square_corners(file, rank);
  const double side = 1 - 2 * kBevel, cell = side / kPits;
  std::uint32_t grid[kPits + 1][kPits + 1];
  for (int r = 0; r <= kPits; ++r) {
    for (int f = 0; f <= kPits; ++f) {
      grid[r][f] = board.add_point(on_board(file + kBevel + f * cell, rank + kBevel + r * cell) + DVector(0, kTop, 0));
    }
  }
  for (int r = 0; r < kPits; ++r) {
    for (int f = 0; f < kPits; ++f) {
      const DVector middle = on_board(file + kBevel + (f + 0.5) * cell, rank + kBevel + (r + 0.5) * cell);
      const std::uint32_t pit = board.add_point(middle + DVector(0, kTop - kPitDepth * cell, 0));
      cap(board, {grid[r][f], grid[r][f + 1], grid[r + 1][f + 1], grid[r + 1][f]}, pit, 0);
    }
  }
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t a = corners[i], b = corners[(i + 1) % 4];
    const auto inner = [&](int k) {
      const int m = kPits;
      return i == 0 ? grid[0][k] : i == 1 ? grid[k][m] : i == 2 ? grid[m][m - k] : grid[m - k][0];
    };
    for (int k = 0; k < kPits; ++k) board.add_triangle(k < kPits / 2 ? a : b, inner(k + 1), inner(k), 0);
    board.add_triangle(a, b, inner(kPits / 2), 0);
  }
}

// Frame, sides and bottom: mitred mouldings around the field; every square's edge ends on the innermost line.
void add_frame(Solid& board) {
  constexpr double kRings[][2] = {{0.05, 0.05},  {0.10, 0.07},  {0.38, 0.07},  {0.44, 0.06}, {0.48, 0.02},
                                  {0.48, -0.18}, {0.52, -0.22}, {0.58, -0.26}, {0.58, -0.38}};
  Ring border;
  for (int k = 0; k < kFiles; ++k) border.push_back(square_corners(k, 0)[0]);
  for (int k = 0; k < kFiles; ++k) border.push_back(square_corners(kFiles - 1, k)[1]);
  for (int k = kFiles; k > 0; --k) border.push_back(square_corners(k - 1, kFiles - 1)[2]);
  for (int k = kFiles; k > 0; --k) border.push_back(square_corners(0, k - 1)[3]);
  Ring before;
  for (const auto& [out, height] : kRings) {
    Ring ring;
    for (int i = 0; i < 4; ++i) {
      const double f = i == 1 || i == 2 ? kFiles + out : -out, r = i >= 2 ? kFiles + out : -out;
      ring.push_back(board.add_point(on_board(f, r) + DVector(0, height, 0)));
    }
    if (before.empty()) {
      for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < kFiles; ++k) {
          const std::uint32_t a = border[i * kFiles + k], b = border[(i * kFiles + k + 1) % border.size()];
          board.add_triangle(b, a, k < kFiles / 2 ? ring[i] : ring[(i + 1) % 4], 0);
        }
        board.add_triangle(ring[i], ring[(i + 1) % 4], border[i * kFiles + kFiles / 2], 0);
      }
    } else {
      bridge(board, ring, before, 0);
    }
    before = ring;
  }
  board.add_quad(before[3], before[2], before[1], before[0], 0);
}

Solid make_board() {
  Solid board;
  for (int r = 0; r <= kFiles; ++r) {
    for (int f = 0; f <= kFiles; ++f) board.add_point(on_board(f, r));
  }
  for (int r = 0; r < kFiles; ++r) {
    for (int f = 0; f < kFiles; ++f) {
      if ((f + r) % 2 == 0) {
        add_dark_square(board, f, r);
      } else {
        add_light_square(board, f, r);
      }
    }
  }
  add_frame(board);
  return board;
}

// An Italian game after three moves: all 32 pieces, some of them out in the open. From rank 8 down to rank 1.
constexpr std::string_view kPosition[kFiles] = {"r.bqk.nr", "pppp.ppp", "..n.....", "..b.p...",
                                                "..B.P...", ".....N..", "PPPP.PPP", "RNBQK..R"};

struct Piece {
  char letter;
  std::string_view name;
  Solid solid;
  double turn;  // about the vertical, to the right of straight ahead
};

// Points around each kind of piece at detail 1. A pawn has 78 faces a point around, a rook 65 and 24 more, a bishop
// 106 less 4, a queen 104, a king 94 and the 92 of his cross, a knight's foot 26, and a horse 132 a side; the board
// has 9,766. 16 pawns, 4 rooks, 4 bishops, 2 queens, 2 kings and 4 knights make it 123,314.
constexpr int kAroundPawn = 32, kAroundRook = 48, kAroundBishop = 36, kAroundQueen = 48, kAroundKing = 41;
constexpr int kAroundFoot = 45, kAroundHorse = 44, kRingsPerSpan = 5;

std::vector<Piece> make_pieces(int detail) {
  const Carving horse{{kAroundFoot * detail, detail}, kRingsPerSpan * detail, kAroundHorse * detail};
  std::vector<Piece> pieces;
  pieces.push_back({'p', "pawn", make_pawn({kAroundPawn * detail, detail}), 0});
  pieces.push_back({'r', "rook", make_rook({kAroundRook * detail, detail}), 0});
  pieces.push_back({'n', "knight", make_knight(horse), -0.9});
  pieces.push_back({'b', "bishop", make_bishop({kAroundBishop * detail, detail}), -0.6});
  pieces.push_back({'q', "queen", make_queen({kAroundQueen * detail, detail}), 0});
  pieces.push_back({'k', "king", make_king({kAroundKing * detail, detail}), 0});
  return pieces;
}

char lower_case(char letter) { return letter < 'a' ? static_cast<char>(letter - 'A' + 'a') : letter; }

void place_pieces(SceneBuilder& scene, const std::vector<Piece>& pieces) {
  for (int row = 0; row < kFiles; ++row) {
    for (int file = 0; file < kFiles; ++file) {
      const char letter = kPosition[row][file];
      for (const Piece& piece : pieces) {
        if (piece.letter != lower_case(letter)) continue;
        const bool white = letter < 'a';
        const std::string square{static_cast<char>('a' + file), static_cast<char>('8' - row)};
        scene.start_part((white ? "white_" : "black_") + std::string(piece.name) + "_" + square);
        const DVector foot = on_board(file + 0.5, kFiles - row - 0.5) + DVector(0, kTop + kFelt, 0);
        const double ahead = white ? elementary::kPi / 2 : -elementary::kPi / 2;
        scene.place(piece.solid, turned_about_y(ahead - piece.turn, foot));
      }
    }
  }
}

}  // namespace

GeneratedScene make_chessboard(int detail) {
  SceneBuilder scene;
  scene.start_part("board");
  scene.place(make_board());
  place_pieces(scene, make_pieces(detail));
  scene.set_camera({-6.9f, 8.3f, 11.5f}, {0.06f, -1.05f, 0.71f}, 46);
  scene.add_light({-8, 8, 4}, {1, 0.97f, 0.92f}, 0.60f);
  scene.add_light({7, 6, 7}, {1, 0.97f, 0.92f}, 0.17f);
  scene.add_light({10, 5, -2}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({5, 7, -9}, {0.92f, 0.96f, 1}, 0.16f);
  scene.add_light({-4, 5, -10}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({-11, 4, -4}, {0.92f, 0.96f, 1}, 0.08f);
  scene.add_light({-1, 4, 12}, {1, 0.97f, 0.92f}, 0.08f);
  scene.add_light({1, 13, 1}, {1, 1, 1}, 0.07f);
  return scene.take();
}

}  // namespace facemap::generators
