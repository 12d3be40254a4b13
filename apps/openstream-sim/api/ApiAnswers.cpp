#include "api/ApiAnswers.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr int BAD_INPUT_STATUS = 400;
constexpr int NOT_NOW_STATUS = 403;
constexpr int NO_PATH_STATUS = 404;

OpenStream::ApiResponse MakeRefusal(int status, std::int32_t code, std::string sentence)
{
    OpenStream::ApiResponse response = Succeed(ErrorAnswer{code, std::move(sentence)});
    response.status = status;
    return response;
}

std::string_view GetSentence(EApiError error)
{
    switch (error)
    {
        case EApiError::NotRemote:
            return "the controller is not in remote mode";
        case EApiError::TaskPlaying:
            return "a task is playing; stop it first";
        case EApiError::MotorOff:
            return "the motor is off; POST /project/robot/motor_on and wait until motor_on_state is 0";
        case EApiError::Playing:
            return "an automatic program is running";
        case EApiError::NoProgram:
            return "no program is selected; POST /project/context/tasks[0]/cur_prog_cnt with the pno of a program";
        case EApiError::EmergencyStop:
            return "the emergency stop is pressed; release it first";
        case EApiError::BufferFull:
            return "the trajectory buffer is full";
        case EApiError::BufferLeft:
            return "the buffer has points of a stopped trajectory; POST joint_traject_init first";
        case EApiError::RemoteSelection:
            return "remote mode accepts only a selection with ext_sel 1";
        case EApiError::LocalSelection:
            return "ext_sel 1 selects in remote mode only";
        case EApiError::BadCounter:
            return "the program counter is invalid; POST /project/context/tasks[0]/set_cur_pc_idx with idx 1 after a start "
                   "or stop, and select a program from 1 to 9999";
        case EApiError::NotInWait:
            return "no program waits";
        case EApiError::Withdrawn:
            return "withdrawn since version 60.30; POST /project/service/r_code/execute resets the tasks";
        case EApiError::AxisTooFast:
            return "E159: the trajectory was too fast for an axis; POST joint_traject_init first";
        case EApiError::NotWaiting:
            return "E01554: no program waits in playback; start one that does (wait di1)";
        case EApiError::Language:
            return "not a statement of the robot language, or an axis is out of its range";
        case EApiError::ProtectiveStop:
            return "a safeguard is open; close it first";
        case EApiError::None:
        case EApiError::BadInput:
        case EApiError::NotServed:
        default:
            return "";
    }
}

} // namespace

OpenStream::ApiResponse Succeed()
{
    return OpenStream::ApiResponse{200, Core::JsonText::FromTrusted(R"({"_type":"JObject"})")};
}

OpenStream::ApiResponse Answer(EApiError error)
{
    return error == EApiError::None ? Succeed()
                                    : Forbid(static_cast<std::int32_t>(error), std::string(GetSentence(error)));
}

OpenStream::ApiResponse Forbid(std::int32_t code, std::string sentence)
{
    return MakeRefusal(NOT_NOW_STATUS, code, std::move(sentence));
}

OpenStream::ApiResponse Refuse(const Core::Error& error)
{
    return MakeRefusal(BAD_INPUT_STATUS, static_cast<std::int32_t>(EApiError::BadInput), Core::Describe(error));
}

OpenStream::ApiResponse RefuseInput(std::string name, std::string expected, std::string found)
{
    return Refuse(Core::Error{Core::ECoreError::OutOfRange, std::move(name), std::move(expected), std::move(found)});
}

OpenStream::ApiResponse RefusePath(const std::string& sentence)
{
    return MakeRefusal(NO_PATH_STATUS, static_cast<std::int32_t>(EApiError::NotServed), sentence);
}

Core::Result<std::int64_t> ReadInteger(
    const OpenStream::ApiRequest& request,
    std::string_view name,
    std::int64_t byDefault,
    std::int64_t lowest,
    std::int64_t highest)
{
    const std::string* textOrNull = request.GetParameterOrNull(name);
    if (textOrNull == nullptr)
    {
        return byDefault;
    }
    const std::optional<std::int64_t> value = Core::ParseNumberOrNull<std::int64_t>(*textOrNull);
    if (!value.has_value() || *value < lowest || *value > highest)
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            std::string(name),
            fmt::format("a whole number from {} to {}", lowest, highest),
            Core::QuoteForError(*textOrNull));
    }
    return *value;
}

} // namespace ACS::OpenStreamSim
