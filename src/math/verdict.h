#pragma once

namespace facemap {

/// A sign that a stage could not settle.
inline constexpr int kUnknownSign = 2;

/// An answer made of several signs: No as soon as one condition surely fails, Unknown if none fails and one is unknown.
enum class Verdict { No, Yes, Unknown };

}  // namespace facemap
