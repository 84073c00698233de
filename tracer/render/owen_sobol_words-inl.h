// SPDX-License-Identifier: MIT
// Formulas of Owen-scrambled Sobol points, written once for a word of 32 bits and for a vector of
// them. To be included within a namespace, once for scalars and once for each instruction set.

template <class Word>
struct WordPair {
  Word x, y;
};

template <class Word>
constexpr Word reverse_bits(Word word) {
  word = word << 16 | word >> 16;
  word = (word & Word(0x00ff00ffu)) << 8 | (word >> 8 & Word(0x00ff00ffu));
  word = (word & Word(0x0f0f0f0fu)) << 4 | (word >> 4 & Word(0x0f0f0f0fu));
  word = (word & Word(0x33333333u)) << 2 | (word >> 2 & Word(0x33333333u));
  return (word & Word(0x55555555u)) << 1 | (word >> 1 & Word(0x55555555u));
}

/// Flips each bit or not, by chance that depends on `seed` and the lower bits: Owen's nested
/// scrambling where the lowest bit is the most significant. [Laine 2011] [Vegdahl 2021]
template <class Word>
constexpr Word scramble_upwards(Word word, uint32_t seed) {
  word = word ^ word * Word(0x3d20adeau);
  word = (word + Word(seed)) * Word(seed >> 16 | 1);
  word = word ^ word * Word(0x05526c56u);
  return word ^ word * Word(0x53a22864u);
}

/// Sobol's point of an index in the first two dimensions, the first digit in the lowest bit. With
/// the index as a polynomial p(t) over the field of two elements, y is p(1 + t). [Sobol 1967]
template <class Word>
constexpr WordPair<Word> sobol_digits(Word index) {
  Word y = index;
  y = y ^ (y >> 16 & Word(0x0000ffffu));
  y = y ^ (y >> 8 & Word(0x00ff00ffu));
  y = y ^ (y >> 4 & Word(0x0f0f0f0fu));
  y = y ^ (y >> 2 & Word(0x33333333u));
  y = y ^ (y >> 1 & Word(0x55555555u));
  return {index, y};
}

/// A place in an order of [0, mask], mask + 1 a power of two, that `key` picks.
template <class Word>
constexpr Word shuffle(Word i, uint32_t mask, Word key) {
  const int half = (std::bit_width(mask) + 1) / 2;
  for (int round = 0; round < 3; ++round) {
    key = key * Word(0x915f77f5u) + Word(0x2c1b3c6du);
    i = (i ^ key >> 16) * (key >> 3 | Word(1)) & Word(mask);
    i = i ^ i >> half;
  }
  return i;
}

/// Both numbers of a point, the first digit in the highest bit. Its index is `index` where the mask
/// has no bits; those within it, in an order that `order` and the seed pick.
template <class Word>
constexpr WordPair<Word> scrambled_point(uint32_t index, uint32_t mask, Word order,
                                         const WordPair<Word>& shift, const SobolSeeds& seeds) {
  const Word key = (order ^ Word(seeds.index)) * Word(0x85ebca6bu);
  const Word shuffled = shuffle(Word(index & mask), mask, key) | Word(index & ~mask);
  const WordPair<Word> point = sobol_digits(shuffled);
  return {reverse_bits(scramble_upwards(point.x ^ shift.x, seeds.x)),
          reverse_bits(scramble_upwards(point.y ^ shift.y, seeds.y))};
}
