#include "robots/NumberTemplate.hpp"

#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

bool IsNumeric(const JobName& name)
{
    return name.segment.has_value() || name.subject == JobName::ESubject::RobotPort
        || name.subject == JobName::ESubject::JobNumber || name.subject == JobName::ESubject::Station;
}

} // namespace

NumberTemplate::NumberTemplate(std::int64_t number)
    : _value(number)
{
}

tl::expected<NumberTemplate, std::string> NumberTemplate::Parse(std::string_view text)
{
    NumberTemplate result;
    if (const std::optional<std::int64_t> number = Core::ParseNumberOrNull<std::int64_t>(text))
    {
        result._value = *number;
        return result;
    }
    const bool bOneName =
        text.starts_with('{') && text.ends_with('}') && text.find_first_of("{}", 1) == text.size() - 1;
    if (!bOneName)
    {
        return tl::unexpected(fmt::format(
            "expected a whole number or exactly one name, such as \"{{from.cp}}\", found {}",
            Core::QuoteForError(text)));
    }
    tl::expected<JobName, std::string> name = ParseJobName(text.substr(1, text.size() - 2));
    if (!name.has_value())
    {
        return tl::unexpected(std::move(name.error()));
    }
    if (!IsNumeric(*name))
    {
        return tl::unexpected(fmt::format("{} is not a number; give a name such as {{from.cp}}", MakeNameText(*name)));
    }
    result._value = std::move(*name);
    return result;
}

const JobName* NumberTemplate::GetNameOrNull() const noexcept
{
    return std::get_if<JobName>(&_value);
}

const std::int64_t* NumberTemplate::GetNumberOrNull() const noexcept
{
    return std::get_if<std::int64_t>(&_value);
}

std::int64_t NumberTemplate::Resolve(const JobData& data) const
{
    const JobName* const name = GetNameOrNull();
    return name == nullptr ? *GetNumberOrNull() : data.GetNumber(*name);
}

} // namespace ACS::Acsd
