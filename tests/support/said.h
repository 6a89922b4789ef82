// Checks and changes of texts, and checks of error messages.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <initializer_list>
#include <string>
#include <string_view>

namespace rotorub::test {

// Whether the text contains all these parts. EXPECT_TRUE shows the missing part and the beginning
// of the text.
inline testing::AssertionResult contains(const std::string& text,
                                         std::initializer_list<std::string_view> parts) {
  const std::string shown = text.substr(0, 4000);
  for (const std::string_view part : parts) {
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "`" << part << "` is missing in:\n" << shown;
  }
  return testing::AssertionSuccess() << shown;
}
inline testing::AssertionResult contains(const std::string& text, std::string_view part) {
  return contains(text, {part});
}

// The message of the Error that the action throws; empty if it throws none. Other exceptions
// propagate.
template <class Error = std::exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

// Replaces the first `from` by `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace rotorub::test
