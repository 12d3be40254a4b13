#pragma once

#include "SeededRandom.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ACS::Simulation
{

/// A seed and the component of the run that it is for.
struct ChanceSeed
{
    std::uint64_t seed = 0;
    std::uint64_t part = 0;
};

/// Random numbers of one component of a run. Each component has its own: leaving out a kind of fault does not change
/// the others.
class ChanceModel final : public Core::IRandom
{
    Testing::SeededRandom _random;

public:
    explicit ChanceModel(const ChanceSeed& seed)
        : _random(seed.seed * 0x2545F4914F6CDD1DU + seed.part * 0xD6E8FEB86659FD93U)
    {
        static_cast<void>(_random.GetNext());
    }

    [[nodiscard]] std::uint64_t GetNext() override
    {
        return _random.GetNext();
    }

    /// 0 up to limit - 1.
    [[nodiscard]] std::size_t GetBelow(std::size_t limit)
    {
        return GetNext() % limit;
    }

    /// Both ends included.
    [[nodiscard]] std::size_t GetBetween(std::size_t least, std::size_t most)
    {
        return least + GetBelow(most - least + 1);
    }

    [[nodiscard]] bool IsHit(std::size_t permille)
    {
        return GetBelow(1'000) < permille;
    }

    [[nodiscard]] Core::Duration GetBetween(std::chrono::milliseconds least, std::chrono::milliseconds most)
    {
        const auto span = std::chrono::duration_cast<std::chrono::microseconds>(most - least).count();
        return least + std::chrono::microseconds(GetBelow(static_cast<std::size_t>(span) + 1));
    }

    template <typename TValue>
    [[nodiscard]] const TValue& Pick(const std::vector<TValue>& values)
    {
        return values[GetBelow(values.size())];
    }
};

} // namespace ACS::Simulation
