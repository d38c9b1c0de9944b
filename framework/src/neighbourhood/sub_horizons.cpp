// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "neighbourhood/sub_horizons.hpp"

#include "periporo/first_exception.hpp"
#include "periporo/pack.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#ifdef __AVX512VBMI2__
#include <immintrin.h>
#endif

namespace periporo {
namespace {

/// Earlier bonds that a sub-horizon may follow from. Points lie along a space-filling curve, so that near neighbours
/// are found among the last; looking at all of them would save 3 per cent of the pairs.
constexpr std::size_t window = 32;
constexpr std::size_t word_bits = 64;
constexpr std::uint64_t lower_bits = 0x5555555555555555; ///< of twins
constexpr std::uint64_t no_way = std::uint64_t{1} << 32; ///< more pairs than any sum takes

/// n/step for every bit n of a word.
template <std::size_t step>
constexpr auto numbers_of_bits = [] {
    std::array<std::uint8_t, word_bits> numbers{};
    for (std::size_t bit = 0; bit < word_bits; ++bit)
        numbers[bit] = static_cast<std::uint8_t>(bit / step);
    return numbers;
}();
constexpr std::size_t slack = word_bits; // places that may be written behind the last member

/// Membership of one family as bits. Row k, bit b: are the neighbours of bonds k and b within the horizon of each
/// other? Words of all rows lie word by word, so that rows are compared side by side.
class Membership {
public:
    void find(const Points& points, const IsometryTable& isometries, const Families& families, std::size_t point,
              double horizon)
    {
        const FamilyView family = families[point];
        count_ = family.count;
        words_ = (count_ + word_bits - 1) / word_bits;
        const std::size_t lanes = family.packs * pack_width;
        for (auto& component : zeta_)
            component.resize(lanes);
        for (std::size_t b = 0; b < lanes; ++b) {
            // Lanes without a bond stand far away from everything.
            Vector3 x = Vector3::Constant(1e3 * horizon * static_cast<double>(b + 2));
            if (b < count_) {
                const std::uint32_t c = family.neighbours[b];
                x = isometries[families.isometry(c)].point(points.position[families.parent(c)]) -
                    points.position[point];
            }
            for (int c = 0; c < 3; ++c)
                zeta_[c][b] = x[c];
        }
        bits_.assign(words_ * count_ + window, 0); // step() looks at a whole window
        const Pack reach_squared = horizon * horizon;
        for (std::size_t p = 0; p < family.packs; ++p) {
            const std::size_t at = p * pack_width;
            Pack x[3];
            for (std::size_t c = 0; c < 3; ++c)
                x[c] = Pack(zeta_[c].data() + at, std::experimental::vector_aligned);
            std::uint64_t* column = bits_.data() + at / word_bits * count_;
            for (std::size_t k = 0; k < count_; ++k) {
                const Pack dx = x[0] - zeta_[0][k];
                const Pack dy = x[1] - zeta_[1][k];
                const Pack dz = x[2] - zeta_[2][k];
                column[k] |= static_cast<std::uint64_t>(lane_bits(dx * dx + dy * dy + dz * dz <= reach_squared))
                             << at % word_bits;
            }
        }
    }

    std::size_t count() const { return count_; }

    struct Step {
        std::uint16_t from;
        std::uint16_t pairs;
    };

    /// The cheapest way to the sum over the sub-horizon of bond b.
    Step step(std::size_t b) const
    {
        std::uint64_t members = 0, others = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            members += visits(word(w, b));
            others += visits(full(w) & ~word(w, b));
        }
        const std::uint64_t best = std::min(members, others);
        const std::uint64_t from = others < members ? count_ + 1 : count_;

        const std::size_t first = b > window ? b - window : 0;
        std::uint64_t enter[window] = {}, leave[window] = {}; // as wide as the words, so that one loop is one vector
        std::fill(enter + (b - first), enter + window, no_way);
        for (std::size_t w = 0; w < words_; ++w) {
            const std::uint64_t own = word(w, b);
            const std::uint64_t* earlier = bits_.data() + w * count_ + first;
#pragma GCC ivdep
            for (std::size_t a = 0; a < window; ++a) { // what is not earlier has no way
                enter[a] += visits(own & ~earlier[a]);
                leave[a] += visits(earlier[a] & ~own);
            }
        }
        std::uint64_t cheapest = best << 16 | from; // pairs above, where from below
        for (std::size_t a = 0; a < window; ++a) {
            const std::uint64_t way = (enter[a] > leave[a] ? enter[a] : leave[a]) << 16 | (first + a);
            cheapest = way < cheapest ? way : cheapest;
        }
        return {static_cast<std::uint16_t>(cheapest), static_cast<std::uint16_t>(cheapest >> 16)};
    }

    /// Writes the members of a step and returns the place behind the last. Touches `slack` places behind that.
    template <class Member>
    Member* write_members(std::size_t b, Step step, Member* members) const
    {
        Member* enter = members;
        Member* leave = members + step.pairs;
        Member* end = leave + step.pairs;
        for (std::size_t w = 0; w < words_; ++w)
            enter = write_word(word(w, b) & ~before(w, step), w, enter);
        std::fill(enter, std::max(enter, leave), static_cast<Member>(count_));
        for (std::size_t w = 0; w < words_; ++w)
            leave = write_word(before(w, step) & ~word(w, b), w, leave);
        std::fill(leave, std::max(leave, end), static_cast<Member>(count_));
        return end;
    }

private:
    std::uint64_t word(std::size_t w, std::size_t row) const
    {
        return bits_[w * count_ + row];
    }
    std::uint64_t full(std::size_t w) const
    {
        const std::size_t bits = std::min(word_bits, count_ - w * word_bits);
        return ~std::uint64_t{0} >> (word_bits - bits);
    }

    std::uint64_t before(std::size_t w, Step step) const
    {
        return step.from < count_ ? word(w, step.from) : step.from == count_ ? 0 : full(w);
    }

    /// The lower bits of twins.
    static std::uint64_t twins(std::uint64_t bits)
    {
        return bits & bits >> 1 & lower_bits;
    }
    /// How many visits the members of a word take: as many as there are pairs of neighbouring bits that are not both
    /// zero. One count alone, and cast at once, is what compilers turn into vector instructions.
    static std::uint64_t visits(std::uint64_t bits)
    {
        return static_cast<std::uint64_t>(std::popcount((bits | bits >> 1) & lower_bits));
    }

    template <class Member>
    Member* write_word(std::uint64_t bits, std::size_t w, Member* out) const
    {
        const std::uint64_t lower = twins(bits);
        out = write_bits<1>(bits & ~(lower | lower << 1), w * word_bits, out);
        return write_bits<2>(lower, SubHorizonView{count_}.first_twins() + w * word_bits / 2, out);
    }

    /// Writes base + n/step of every bit n that is set and returns the place behind the last.
    template <std::size_t step, class Member>
    static Member* write_bits(std::uint64_t bits, std::size_t base, Member* out)
    {
#ifdef __AVX512VBMI2__
        if constexpr (sizeof(Member) == 1) {
            const __m512i numbers = _mm512_loadu_si512(numbers_of_bits<step>.data());
            const __m512i set = _mm512_maskz_compress_epi8(bits, numbers);
            _mm512_storeu_si512(out, _mm512_add_epi8(set, _mm512_set1_epi8(static_cast<char>(base))));
            return out + std::popcount(bits);
        }
#endif
        for (; bits != 0; bits &= bits - 1)
            *out++ = static_cast<Member>(base + static_cast<std::size_t>(std::countr_zero(bits)) / step);
        return out;
    }

    std::size_t count_ = 0;
    std::size_t words_ = 0;
    AlignedVector<double> zeta_[3];
    std::vector<std::uint64_t> bits_;
};

/// Finds the ways to all sums of one family and sorts them by their pairs.
class ChangeOrder {
public:
    /// Fills `from` and `changes`; returns all pairs.
    std::size_t find(const Membership& membership, std::uint16_t* from, std::span<SubHorizonView::Change> changes)
    {
        const std::size_t count = changes.size();
        pairs_.resize(count);
        first_.assign(count + 2, 0); // no sum takes more pairs than there are members
        std::size_t all = 0;
        for (std::size_t b = 0; b < count; ++b) {
            const Membership::Step step = membership.step(b);
            from[b] = step.from;
            pairs_[b] = step.pairs;
            ++first_[step.pairs + std::size_t{1}];
            all += step.pairs;
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        for (std::size_t b = 0; b < count; ++b)
            changes[first_[pairs_[b]]++] = {static_cast<std::uint16_t>(b), pairs_[b]};
        return all;
    }

private:
    std::vector<std::uint16_t> pairs_;
    std::vector<std::uint16_t> first_; // of the changes with so many pairs
};

} // namespace

void SubHorizons::find(const Points& points, const IsometryTable& isometries, const Families& families, double horizon)
{
    const std::size_t n = families.points();
    first_bond_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        first_bond_[i + 1] = first_bond_[i] + families[i].count;
    from_.resize(first_bond_[n]);
    changes_.resize(first_bond_[n]);
    first_byte_.resize(n);
    members_.resize((n + block_size - 1) / block_size);
    FirstException failure;
#pragma omp parallel
    {
        Membership membership;
        ChangeOrder order;
        std::vector<std::uint8_t> members; // so that those kept have no more room than they need
        const auto find_members = [&](std::size_t block) {
            members.clear();
            for (std::size_t i = block * block_size; i < std::min(n, (block + 1) * block_size); ++i) {
                membership.find(points, isometries, families, i, horizon);
                std::uint16_t* from = from_.data() + first_bond_[i];
                const std::span changes(changes_.data() + first_bond_[i], membership.count());
                const std::size_t pairs = order.find(membership, from, changes);
                const bool wide = SubHorizonView{membership.count()}.wide();
                const std::size_t first = members.size() + members.size() % 2;
                first_byte_[i] = static_cast<std::uint32_t>(first);
                const std::size_t member = wide ? sizeof(std::uint16_t) : sizeof(std::uint8_t);
                const std::size_t bytes = 2 * pairs * member;
                members.resize(first + bytes + slack * member);
                const auto write = [&](auto* next) {
                    for (const auto [bond, its_pairs] : changes)
                        next = membership.write_members(bond, {from[bond], its_pairs}, next);
                };
                if (wide)
                    write(reinterpret_cast<std::uint16_t*>(members.data() + first));
                else
                    write(members.data() + first);
                members.resize(first + bytes);
            }
            members_[block].assign(members.begin(), members.end());
        };
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < members_.size(); ++block)
            failure.guard(block, [&] { find_members(block); });
    }
    failure.rethrow();
}

std::size_t SubHorizons::memory() const
{
    std::size_t bytes = from_.capacity() * sizeof(std::uint16_t) +
                        changes_.capacity() * sizeof(SubHorizonView::Change) +
                        first_bond_.capacity() * sizeof(std::size_t) + first_byte_.capacity() * sizeof(std::uint32_t);
    for (const AlignedVector<std::uint8_t>& block_members : members_)
        bytes += sizeof(block_members) + block_members.capacity();
    return bytes;
}

} // namespace periporo
