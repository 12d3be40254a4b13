#pragma once

#include "api/ApiMessages.hpp"
#include "arm/TrajectoryFollower.hpp"
#include "arm/TrajectoryPoints.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/json/JsonFields.hpp>

// The members of the Open API's bodies and their ranges, in one place.

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::HealthAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("status", &OpenStreamSim::HealthAnswer::status));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::RobotAnswer>
{
    using Message = OpenStreamSim::RobotAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("status", &Message::status),
        Required("motor_on_state", &Message::motorOnState),
        Required("is_playback", &Message::isPlayback),
        Required("is_remote_mode", &Message::isRemoteMode),
        Required("tool_no", &Message::toolNo),
        Required("cur_prog_no", &Message::programNo),
        Required("alarm", &Message::alarm),
        Required("position", &Message::position));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::JointStatesAnswer>
{
    using Message = OpenStreamSim::JointStatesAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("position", &Message::position),
        Required("velocity", &Message::velocity),
        Required("effort", &Message::effort));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::PoseAnswer>
{
    using Message = OpenStreamSim::PoseAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("nsync", &Message::nsync),
        Required("mechinfo", &Message::mechinfo),
        Required("crd", &Message::crd),
        Optional("x", &Message::x),
        Optional("y", &Message::y),
        Optional("z", &Message::z),
        Optional("rx", &Message::rx),
        Optional("ry", &Message::ry),
        Optional("rz", &Message::rz),
        Optional("j1", &Message::j1),
        Optional("j2", &Message::j2),
        Optional("j3", &Message::j3),
        Optional("j4", &Message::j4),
        Optional("j5", &Message::j5),
        Optional("j6", &Message::j6),
        Optional("enc_cur", &Message::encCur));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::GeneralAnswer>
{
    using Message = OpenStreamSim::GeneralAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robot_model", &Message::robotModel),
        Required("cur_mode", &Message::curMode),
        Required("enable_state", &Message::enableState),
        Required("is_playback", &Message::isPlayback),
        Required("is_remote_mode", &Message::isRemoteMode),
        Required("is_ext_start", &Message::isExtStart),
        Required("is_ext_prog_sel", &Message::isExtProgSel),
        Required("cur_prog_no", &Message::curProgNo),
        Required("cur_step_no", &Message::curStepNo),
        Required("cur_func_no", &Message::curFuncNo),
        Required("mov_prog_no", &Message::movProgNo),
        Required("mov_step_no", &Message::movStepNo),
        Required("mov_func_no", &Message::movFuncNo),
        Required("spd_lev", &Message::spdLev),
        Required("manual_spd_max", &Message::manualSpdMax),
        Required("auto_spd", &Message::autoSpd),
        Required("jog_inch_status", &Message::jogInchStatus),
        Required("step_execute_unit_status", &Message::stepExecuteUnitStatus),
        Required("cont_path", &Message::contPath),
        Required("tool_no", &Message::toolNo),
        Required("ucrd_no", &Message::ucrdNo),
        Required("cur_crd", &Message::curCrd),
        Required("base_intp", &Message::baseIntp),
        Required("plc_mode", &Message::plcMode),
        Required("task_no", &Message::taskNo),
        Required("axis_lock", &Message::axisLock),
        Required("call_depth", &Message::callDepth),
        Required("call_pno", &Message::callPno),
        Required("job_state", &Message::jobState),
        Required("job_sub_state", &Message::jobSubState),
        Required("next_exe_pno", &Message::nextExePno),
        Required("cur_mech_no", &Message::curMechNo),
        Required("cur_mech_axis_info", &Message::curMechAxisInfo),
        Required("eid_last_err", &Message::eidLastErr),
        Required("eid_last_warn", &Message::eidLastWarn),
        Required("eid_last_noti", &Message::eidLastNoti),
        Required("eid_last_con_out", &Message::eidLastConOut),
        Required("eid_last_start_stop", &Message::eidLastStartStop),
        Required("eid_last_history", &Message::eidLastHistory),
        Required("in_position", &Message::inPosition),
        Required("task_enable", &Message::taskEnable),
        Required("axis_ctrl", &Message::axisCtrl));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::NumberAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("val", &OpenStreamSim::NumberAnswer::val));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::FloatAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("val", &OpenStreamSim::FloatAnswer::val));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::Tool>
{
    using Message = OpenStreamSim::Tool;
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Message::x),
        Required("y", &Message::y),
        Required("z", &Message::z),
        Required("rx", &Message::rx),
        Required("ry", &Message::ry),
        Required("rz", &Message::rz),
        Required("mass", &Message::mass),
        Required("cx", &Message::cx),
        Required("cy", &Message::cy),
        Required("cz", &Message::cz),
        Required("ixx", &Message::ixx),
        Required("iyy", &Message::iyy),
        Required("izz", &Message::izz),
        Required("mass_esti", &Message::massEsti),
        Required("bias_0", &Message::bias0),
        Required("bias_1", &Message::bias1),
        Required("bias_2", &Message::bias2),
        Required("bias_3", &Message::bias3),
        Required("bias_4", &Message::bias4),
        Required("bias_5", &Message::bias5));
};

template <>
struct ACS::Json::ValueDecoder<ACS::OpenStreamSim::PlaybackMode>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        OpenStreamSim::PlaybackMode& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        if (value.IsTrue())
        {
            out = OpenStreamSim::PlaybackMode{};
            return true;
        }
        return ValueDecoder<int>::TryDecode(value, out.value, bounds, context);
    }
};

template <>
struct ACS::Json::ValueEncoder<ACS::OpenStreamSim::PlaybackMode>
{
    static void Encode(const OpenStreamSim::PlaybackMode& value, JsonWriter& writer)
    {
        writer.WriteInteger(value.value);
    }
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::OperatingConditions>
{
    using Message = OpenStreamSim::OperatingConditions;
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("playback_mode", &Message::playbackMode).Between(1, 2),
        Defaulted("step_goback_max_spd", &Message::stepGobackMaxSpd).Between(10, 250),
        Defaulted("step_go_func_ex", &Message::stepGoFuncEx),
        Defaulted("func_reexe_on_trace", &Message::funcReexeOnTrace),
        Defaulted("path_recov_confirm", &Message::pathRecovConfirm),
        Defaulted("playback_spd_rate", &Message::playbackSpdRate).Between(1, 100),
        Defaulted("robot_lock", &Message::robotLock),
        Defaulted("intp_base", &Message::intpBase).Between(0, 1),
        Defaulted("ucrd_num", &Message::ucrdNum).Between(0, 20),
        Defaulted("plc_mode", &Message::plcMode).Between(0, 4));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::OutputCommand>
{
    using Message = OpenStreamSim::OutputCommand;
    static constexpr auto FIELDS = std::make_tuple(
        Required("type", &Message::type),
        Defaulted("blk_no", &Message::blkNo).Between(0, 9),
        Required("sig_no", &Message::sigNo),
        Required("val", &Message::val));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::RelayCommand>
{
    using Message = OpenStreamSim::RelayCommand;
    static constexpr auto FIELDS =
        std::make_tuple(Required("name", &Message::name), Required("value", &Message::value));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ToolCommand>
{
    static constexpr auto FIELDS = std::make_tuple(Required("val", &OpenStreamSim::ToolCommand::val).Between(0, 31));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::CoordinatesCommand>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("val", &OpenStreamSim::CoordinatesCommand::val).Between(-1, 3));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::CoordinatesAnswer>
{
    using Message = OpenStreamSim::CoordinatesAnswer;
    static constexpr auto FIELDS =
        std::make_tuple(Required("cur_crd", &Message::curCrd), Required("ucrd_no", &Message::ucrdNo));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::EmergencyStopCommand>
{
    static constexpr auto FIELDS =
        std::make_tuple(Defaulted("val", &OpenStreamSim::EmergencyStopCommand::val).Between(0, 1));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ProgramCounterCommand>
{
    using Message = OpenStreamSim::ProgramCounterCommand;
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("pno", &Message::pno).Between(-1, 9999),
        Defaulted("sno", &Message::sno).Between(-1, 9999),
        Defaulted("fno", &Message::fno).Between(-1, 9999),
        Defaulted("ext_sel", &Message::extSel).Between(0, 1));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ProgramCounterAnswer>
{
    using Message = OpenStreamSim::ProgramCounterAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("sno_new", &Message::snoNew),
        Required("fno_new", &Message::fnoNew),
        Required("ln_new", &Message::lnNew),
        Required("ofs_moved", &Message::ofsMoved));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::MoveCommand>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("stmt", &OpenStreamSim::MoveCommand::stmt).WithLength(0, 1'000));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ConsoleCommand>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("cmd_line", &OpenStreamSim::ConsoleCommand::cmdLine).WithLength(0, 1'000));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ConsoleAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("ecode", &OpenStreamSim::ConsoleAnswer::ecode));
};

/// The body of joint_traject_init, and the answer of joint_traject_agility_info.
template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::TrajectoryAgility>
{
    using Message = OpenStreamSim::TrajectoryAgility;
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("agility_mode", &Message::bOn),
        Defaulted("agility_freq", &Message::frequency).Between(0.0, 500.0));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::StreamedPoint>
{
    using Message = OpenStreamSim::StreamedPoint;
    static constexpr auto FIELDS = std::make_tuple(
        Required("interval", &Message::interval).Between(0.0001, 60.0),
        Defaulted("time_from_start", &Message::timeFromStart)
            .Between(-OpenStreamSim::LONGEST_TRAJECTORY, OpenStreamSim::LONGEST_TRAJECTORY),
        Required("look_ahead_time", &Message::lookAheadTime).Between(0.0, 60.0),
        Required("point", &Message::point).WithLength(OpenStreamSim::AXES, OpenStreamSim::AXES));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ModeAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("mode", &OpenStreamSim::ModeAnswer::bMode));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ReadyAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("ready", &OpenStreamSim::ReadyAnswer::bReady));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::LogCommand>
{
    static constexpr auto FIELDS = std::make_tuple(Required("enable", &OpenStreamSim::LogCommand::bEnable));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::PcIndexCommand>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("idx", &OpenStreamSim::PcIndexCommand::idx).Between(0, 1'000'000));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ServiceCode>
{
    static constexpr auto FIELDS = std::make_tuple(Required("code", &OpenStreamSim::ServiceCode::code).Between(0, 1));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ModuleVersion>
{
    using Message = OpenStreamSim::ModuleVersion;
    static constexpr auto FIELDS = std::make_tuple(
        Required("name", &Message::name),
        Required("ver", &Message::ver),
        Required("build-date", &Message::buildDate),
        Required("build-time", &Message::buildTime),
        Required("commit-id", &Message::commitID));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::VersionsAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("modules", &OpenStreamSim::VersionsAnswer::modules));
};

template <>
struct ACS::Json::JsonFields<ACS::OpenStreamSim::ErrorAnswer>
{
    using Message = OpenStreamSim::ErrorAnswer;
    static constexpr auto FIELDS =
        std::make_tuple(Required("err_code", &Message::errCode), Required("err_msg", &Message::errMsg));
};
