#include "scenario/ObjectReader.hpp"

#include "common/config/DurationText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::McsSim
{

namespace
{

std::string_view GetView(const Json::Value& text)
{
    return {text.GetString(), text.GetStringLength()};
}

} // namespace

ObjectReader::ObjectReader(const Json::Value& object, std::string path)
    : _object(object),
      _path(std::move(path))
{
    if (!_object.IsObject())
    {
        Refuse({Core::ECoreError::WrongType, _path, "an object", Json::ShortenForError(_object)});
    }
}

bool ObjectReader::HasMember(std::string_view name) const
{
    return _object.IsObject()
        && _object.FindMember(Json::Value(rapidjson::StringRef(name.data(), name.size()))) != _object.MemberEnd();
}

const Json::Value* ObjectReader::TakeOrNull(std::string_view name)
{
    if (!_object.IsObject())
    {
        return nullptr;
    }
    const auto found = _object.FindMember(Json::Value(rapidjson::StringRef(name.data(), name.size())));
    if (std::find(_taken.begin(), _taken.end(), name) == _taken.end())
    {
        _taken.push_back(name);
    }
    return found == _object.MemberEnd() ? nullptr : &found->value;
}

const Json::Value* ObjectReader::TakeRequiredOrNull(std::string_view name, std::string_view expected)
{
    const Json::Value* const valueOrNull = TakeOrNull(name);
    if (valueOrNull == nullptr)
    {
        Refuse(name, std::string(expected), "nothing");
    }
    return valueOrNull;
}

std::string ObjectReader::TakeText(std::string_view name)
{
    const Json::Value* const valueOrNull = TakeRequiredOrNull(name, "a text");
    if (valueOrNull == nullptr)
    {
        return {};
    }
    if (!valueOrNull->IsString() || valueOrNull->GetStringLength() == 0)
    {
        Refuse(name, "a text", Json::ShortenForError(*valueOrNull));
        return {};
    }
    return std::string(GetView(*valueOrNull));
}

std::string ObjectReader::TakeText(std::string_view name, std::string_view otherwise)
{
    return HasMember(name) ? TakeText(name) : std::string(otherwise);
}

bool ObjectReader::IsTrue(std::string_view name, bool bOtherwise)
{
    const Json::Value* const valueOrNull = TakeOrNull(name);
    if (valueOrNull == nullptr)
    {
        return bOtherwise;
    }
    if (!valueOrNull->IsBool())
    {
        Refuse(name, "true or false", Json::ShortenForError(*valueOrNull));
        return bOtherwise;
    }
    return valueOrNull->GetBool();
}

std::uint32_t ObjectReader::TakeNumber(
    std::string_view name,
    std::uint32_t otherwise,
    std::uint32_t smallest,
    std::uint32_t greatest)
{
    const Json::Value* const valueOrNull = TakeOrNull(name);
    if (valueOrNull == nullptr)
    {
        return otherwise;
    }
    if (!valueOrNull->IsUint() || valueOrNull->GetUint() < smallest || valueOrNull->GetUint() > greatest)
    {
        Refuse(
            name,
            fmt::format("a whole number from {} to {}", smallest, greatest),
            Json::ShortenForError(*valueOrNull));
        return otherwise;
    }
    return valueOrNull->GetUint();
}

std::chrono::milliseconds ObjectReader::TakeDuration(std::string_view name)
{
    const Json::Value* const valueOrNull = TakeRequiredOrNull(name, "a duration such as \"5s\"");
    if (valueOrNull == nullptr)
    {
        return {};
    }
    const auto duration = Apps::ParseDuration(valueOrNull->IsString() ? GetView(*valueOrNull) : "");
    if (!duration.has_value())
    {
        Refuse(name, duration.error().expected, Json::ShortenForError(*valueOrNull));
        return {};
    }
    return *duration;
}

std::chrono::milliseconds ObjectReader::TakeDuration(std::string_view name, std::chrono::milliseconds otherwise)
{
    return HasMember(name) ? TakeDuration(name) : otherwise;
}

std::string ObjectReader::GetPath(std::string_view name) const
{
    return _path.empty() ? std::string(name) : fmt::format("{}.{}", _path, name);
}

void ObjectReader::Refuse(std::string_view name, std::string expected, std::string found)
{
    Refuse({Core::ECoreError::WrongType, GetPath(name), std::move(expected), std::move(found)});
}

void ObjectReader::Refuse(Core::Error error)
{
    if (!_error.has_value())
    {
        _error = std::move(error);
    }
}

bool ObjectReader::HasFailed() const noexcept
{
    return _error.has_value();
}

Core::Result<void> ObjectReader::Finish()
{
    if (!_error.has_value())
    {
        for (const auto& member : _object.GetObject())
        {
            const std::string_view name = GetView(member.name);
            if (std::find(_taken.begin(), _taken.end(), name) == _taken.end())
            {
                Refuse(
                    {Core::ECoreError::UnknownWord,
                     _path,
                     fmt::format("one of the members {}", fmt::join(_taken, ", ")),
                     Core::QuoteForError(name)});
            }
        }
    }
    if (_error.has_value())
    {
        return tl::make_unexpected(*_error);
    }
    return {};
}

} // namespace ACS::McsSim
