// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tracer {

using Vector = std::array<double, 3>;

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator*(double s, const Vector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector& a) {
  return std::sqrt(dot(a, a));
}

struct ObjFace {
  std::vector<size_t> corners, normals;  // from 0; no normals where the file gives none
  std::string group, material;
};

struct ObjFaces {
  std::vector<Vector> positions, normals;
  std::vector<ObjFace> faces;
};

/// Reads the v, vn, f, g and usemtl of a well-formed OBJ file; independent of the real parser.
inline ObjFaces read_obj_faces(const std::string& path) {
  ObjFaces obj;
  ObjFace face;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "g") words >> face.group;
    if (word == "usemtl") words >> face.material;
    if (word == "v" || word == "vn") {
      Vector& a = (word == "v" ? obj.positions : obj.normals).emplace_back();
      words >> a[0] >> a[1] >> a[2];
    }
    if (word != "f") continue;
    face.corners.clear();
    face.normals.clear();
    while (words >> word) {
      face.corners.push_back(std::stoul(word) - 1);
      const size_t last_slash = word.rfind('/');
      if (last_slash != std::string::npos) {
        face.normals.push_back(std::stoul(word.substr(last_slash + 1)) - 1);
      }
    }
    obj.faces.push_back(face);
  }
  return obj;
}

/// Twice the face's area along its normal, counterclockwise corners seen from the tip.
inline Vector area_vector(const ObjFaces& obj, const ObjFace& face) {
  Vector sum{};
  const Vector& first = obj.positions[face.corners[0]];
  for (size_t i = 2; i < face.corners.size(); ++i) {
    sum = sum +
          cross(obj.positions[face.corners[i - 1]] - first, obj.positions[face.corners[i]] - first);
  }
  return sum;
}

using Edge = std::pair<size_t, size_t>;

/// How often each directed edge occurs: once, where a surface is consistently oriented.
inline std::map<Edge, int> directed_edges(const ObjFaces& obj) {
  std::map<Edge, int> edges;
  for (const ObjFace& face : obj.faces) {
    for (size_t i = 0; i < face.corners.size(); ++i) {
      ++edges[{face.corners[i], face.corners[(i + 1) % face.corners.size()]}];
    }
  }
  return edges;
}

/// The edges of one face only, each from its first to its second vertex.
inline std::map<size_t, size_t> boundary(const std::map<Edge, int>& edges) {
  std::map<size_t, size_t> next;
  for (const auto& [edge, count] : edges) {
    if (!edges.contains({edge.second, edge.first})) next.insert(edge);
  }
  return next;
}

/// Lengths, in edges, of the closed loops that the boundary consists of, ascending.
inline std::vector<size_t> loop_lengths(std::map<size_t, size_t> next) {
  std::vector<size_t> lengths;
  while (!next.empty()) {
    size_t& edge_count = lengths.emplace_back(0);
    for (auto edge = next.begin(); edge != next.end(); ++edge_count) {
      const size_t vertex = edge->second;
      next.erase(edge);
      edge = next.find(vertex);
    }
  }
  std::ranges::sort(lengths);
  return lengths;
}

}  // namespace tracer
