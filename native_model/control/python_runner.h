// The Python program that runs users' laws in a process.
//
// Requests and answers are bytes behind their length (uint32). A request begins with a byte that
// says which it is, and the number of the law (uint32); an answer begins with a byte 0, or with a
// byte 1 and then why the law failed.
//
//   L  path of the law's file             imports it; answers the word of its command
//   C  JSON: setup, shape, commands       calls create(), state_size() and start(); answers the
//                                         start of the state
//   S  the numbers of `shape`, the state  calls step(); answers the command and the state
//   E                                     calls destroy(), and forgets the law
//
// Numbers are doubles. shape: name and count of each measured value, in their order; the count is
// "float" or "int" for a single number.
#pragma once

#include <string_view>

namespace rotorub {

std::string_view python_runner();

}  // namespace rotorub
