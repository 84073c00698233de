// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_obj.h"

#include "tracer/base/parallel.h"
#include "tracer/obj/join_chunks.h"
#include "tracer/obj/obj_chunk.h"

namespace tracer {
namespace {

constexpr size_t usual_chunk_bytes = size_t{1} << 18;

/// The first end of a line from `at` on that no backslash continues, past its last byte.
size_t find_statement_end(std::string_view bytes, size_t at) {
  while (at < bytes.size()) {
    const size_t line_end = bytes.find_first_of("\n\r", at);
    if (line_end == bytes.npos) return bytes.size();
    size_t first = line_end;
    if (bytes[first] == '\n' && first > 0 && bytes[first - 1] == '\r') --first;
    at = line_end + 1;
    if (bytes[line_end] == '\r' && at < bytes.size() && bytes[at] == '\n') ++at;
    if (first == 0 || bytes[first - 1] != '\\') return at;
  }
  return bytes.size();
}

std::vector<std::string_view> split_chunks(std::string_view bytes, size_t chunk_bytes) {
  std::vector<std::string_view> chunks;
  for (size_t begin = 0; begin < bytes.size();) {
    const size_t end = chunk_bytes < bytes.size() - begin
                           ? find_statement_end(bytes, begin + chunk_bytes - 1)
                           : bytes.size();
    chunks.push_back(bytes.substr(begin, end - begin));
    begin = end;
  }
  return chunks;
}

std::string_view without_byte_order_mark(std::string_view bytes) {
  return bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

}  // namespace

ObjFile parse_obj_in_chunks(std::string_view bytes, const std::string& path, size_t chunk_bytes,
                            Progress& progress) {
  progress.start_stage("reading");
  const auto texts = split_chunks(without_byte_order_mark(bytes), chunk_bytes);
  std::vector<ObjChunk> chunks(texts.size());
  std::atomic<size_t> bytes_done{0};
  parallel_for_each_index(0, texts.size(), [&](size_t i) {
    progress.throw_if_stopped();
    chunks[i] = parse_obj_chunk(texts[i]);
    const size_t done = bytes_done.fetch_add(texts[i].size()) + texts[i].size();
    progress.set_fraction(static_cast<double>(done) / static_cast<double>(bytes.size()));
  });
  return join_chunks(std::move(chunks), path, progress);
}

ObjFile parse_obj(std::string_view bytes, const std::string& path, Progress& progress) {
  return parse_obj_in_chunks(bytes, path, usual_chunk_bytes, progress);
}

}  // namespace tracer
