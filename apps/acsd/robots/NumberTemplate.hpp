#pragma once

#include "robots/JobData.hpp"
#include "robots/JobName.hpp"

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Acsd
{

/// A whole number, as it is or by exactly one name of the job: 7, "{from.cp}".
class NumberTemplate final
{
    std::variant<std::int64_t, JobName> _value;

public:
    explicit NumberTemplate(std::int64_t number = 0);

    /// The error is a text for a person.
    [[nodiscard]] static tl::expected<NumberTemplate, std::string> Parse(std::string_view text);

    /// Null for a number as it is.
    [[nodiscard]] const JobName* GetNameOrNull() const noexcept;

    /// Null for a name.
    [[nodiscard]] const std::int64_t* GetNumberOrNull() const noexcept;

    [[nodiscard]] std::int64_t Resolve(const JobData& data) const;
};

} // namespace ACS::Acsd
