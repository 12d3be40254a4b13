#include "common/process/SystemRandom.hpp"

#include <array>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t SEED_WORDS = 8;

std::mt19937_64 MakeEngine()
{
    std::random_device device;
    std::array<std::random_device::result_type, SEED_WORDS> words{};
    for (auto& word : words)
    {
        word = device();
    }
    std::seed_seq seed(words.begin(), words.end());
    return std::mt19937_64(seed);
}

} // namespace

SystemRandom::SystemRandom()
    : _engine(MakeEngine())
{
}

std::uint64_t SystemRandom::GetNext()
{
    return _engine();
}

} // namespace ACS::Apps
