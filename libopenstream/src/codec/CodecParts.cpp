#include "CodecParts.hpp"

#include <algorithm>

namespace ACS::OpenStream::Detail
{

namespace
{

/// JSON may hold line ends between its tokens, a line may not.
void RemoveLineEnds(std::string& out, std::size_t begin)
{
    const auto isLineEnd = [](char letter) {
        return letter == '\n' || letter == '\r';
    };
    std::replace_if(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(), isLineEnd, ' ');
}

} // namespace

std::string_view GetText(const Json::Value& value)
{
    return {value.GetString(), value.GetStringLength()};
}

const Json::Value* FindMemberOrNull(const Json::Value& object, const char* name)
{
    const auto member = object.FindMember(name);
    return member == object.MemberEnd() ? nullptr : &member->value;
}

void WriteOptional(std::string_view name, const std::optional<Core::JsonText>& valueOrNull, Json::JsonWriter& writer)
{
    if (valueOrNull.has_value())
    {
        writer.Key(name);
        writer.WriteRaw(*valueOrNull);
    }
}

void EndLine(std::size_t begin, Json::JsonWriter& writer, std::string& out)
{
    writer.EndObject();
    RemoveLineEnds(out, begin);
    out += '\n';
}

} // namespace ACS::OpenStream::Detail
