#pragma once

namespace ACS::Apps
{

/// Lets the process have as many descriptors as the system allows it: the usual limit of 1024 is soft, and too few for
/// a program that plays hundreds of machines. Nothing happens where the system refuses.
void RaiseFileLimit();

} // namespace ACS::Apps
