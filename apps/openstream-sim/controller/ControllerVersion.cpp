#include "controller/ControllerVersion.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstddef>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view FORM = "NN.NN-NN";

bool IsDigit(char letter)
{
    return letter >= '0' && letter <= '9';
}

} // namespace

std::optional<ControllerVersion> ParseControllerVersionOrNull(std::string_view text)
{
    constexpr std::array<std::size_t, 3> FIELDS{0, 3, 6};
    constexpr std::size_t DIGITS = 2;
    if (text.size() != FORM.size())
    {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < FORM.size(); ++i)
    {
        if (FORM[i] == 'N' ? !IsDigit(text[i]) : text[i] != FORM[i])
        {
            return std::nullopt;
        }
    }
    std::array<int, FIELDS.size()> numbers{};
    for (std::size_t i = 0; i < FIELDS.size(); ++i)
    {
        const std::string_view digits = text.substr(FIELDS.at(i), DIGITS);
        static_cast<void>(std::from_chars(digits.data(), digits.data() + digits.size(), numbers.at(i)));
    }
    return ControllerVersion{numbers[0], numbers[1], numbers[2]};
}

std::string MakeText(const ControllerVersion& version)
{
    return fmt::format("{:02}.{:02}-{:02}", version.major, version.minor, version.patch);
}

} // namespace ACS::OpenStreamSim
