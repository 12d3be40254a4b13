#pragma once

#include "Timeline.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

/// The events of a run, line by line if requested, and the rules that were violated.
class Trace final
{
    const Timeline& _timeline;
    bool _bPrinting;
    std::vector<std::string> _violations;

public:
    Trace(const Timeline& timeline, bool bPrinting)
        : _timeline(timeline),
          _bPrinting(bPrinting)
    {
    }

    template <typename... TValues>
    void Add(fmt::format_string<TValues...> text, TValues&&... values) const
    {
        if (_bPrinting)
        {
            Print(fmt::format(text, std::forward<TValues>(values)...));
        }
    }

    template <typename... TValues>
    void Violate(fmt::format_string<TValues...> text, TValues&&... values)
    {
        _violations.push_back(fmt::format(text, std::forward<TValues>(values)...));
        if (_bPrinting)
        {
            Print("VIOLATION: " + _violations.back());
        }
    }

    [[nodiscard]] bool IsPrinting() const noexcept
    {
        return _bPrinting;
    }

    [[nodiscard]] const std::vector<std::string>& GetViolations() const noexcept
    {
        return _violations;
    }

private:
    void Print(const std::string& line) const
    {
        const auto age = std::chrono::duration_cast<std::chrono::microseconds>(_timeline.GetAge());
        constexpr double MICROSECONDS = 1e6;
        fmt::print("{:12.6f} {}\n", static_cast<double>(age.count()) / MICROSECONDS, line);
    }
};

} // namespace ACS::Simulation
