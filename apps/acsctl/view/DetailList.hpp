#pragma once

#include "view/EStyle.hpp"
#include "view/TextTable.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// Lines "Label  value", the values below each other; long values continue on the next line.
class DetailList final
{
    struct Detail
    {
        std::string label;
        std::string value;
        EStyle style;
    };

    std::vector<Detail> _details;

public:
    void Add(std::string_view label, std::string_view value, EStyle style = EStyle::Plain);
    /// Nothing if the value is empty.
    void AddIfAny(std::string_view label, std::string_view value, EStyle style = EStyle::Plain);

    [[nodiscard]] std::string Print(const Screen& screen) const;
};

/// Appends the text as lines that begin with this number of blanks, each within the screen.
void AppendIndented(std::string& out, std::string_view text, std::size_t indent, const Screen& screen);

} // namespace ACS::Acsctl
