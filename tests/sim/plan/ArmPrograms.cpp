#include "ArmPrograms.hpp"

namespace ACS::Simulation
{

const std::map<std::string, ArmProgramTexts>& GetArmPrograms()
{
    static const std::map<std::string, ArmProgramTexts> PROGRAMS{
        {"TrayLoad",
         {11,
          {{"ml105", "{job_number}"},
           {"ml106", "{from.area}"},
           {"ml107", "{from.cp}"},
           {"ml108", "{from.tp}"},
           {"ml109", "{robot_port}"}},
          {"A{ml106}.CP{ml107}.TP{ml108}"},
          {"{robot}.TP{ml109}"},
          {}}},
        {"MemoryPickAndPlace",
         {12,
          {{"ml105", "{job_number}"},
           {"ml106", "{from.area}"},
           {"ml107", "{from.set}"},
           {"ml108", "{from.tp}"},
           {"ml109", "{from.mp}"},
           {"ml112", "{to.area}"},
           {"ml113", "{to.set}"},
           {"ml114", "{to.tp}"},
           {"ml115", "{to.mp}"}},
          {"A{ml106}.SET{ml107}.MP{ml109}", "{robot}.TP{ml108}.MP{ml109}"},
          {"A{ml112}.SET{ml113}.MP{ml115}", "{robot}.TP{ml114}.MP{ml115}"},
          {}}},
        {"TrayUnload",
         {13,
          {{"ml105", "{job_number}"},
           {"ml106", "{to.area}"},
           {"ml107", "{to.cp}"},
           {"ml108", "{to.tp}"},
           {"ml900", "{robot_port}"}}, // a second range that is read back
          {"{robot}.TP{ml900}"},
          {"A{ml106}.CP{ml107}.TP{ml108}"},
          {}}},
        {"OpenSetCover",
         {14,
          {{"ml105", "{job_number}"}, {"ml106", "{position.area}"}, {"ml107", "{position.set}"}},
          {},
          {},
          "A{ml106}.SET{ml107}"}}};
    return PROGRAMS;
}

} // namespace ACS::Simulation
