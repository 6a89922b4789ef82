#include "native_model/control/python_runner.h"

namespace rotorub {

std::string_view python_runner() {
  return R"python(
import os, signal, struct, sys, _thread

CONNECTION = int(sys.argv[1])
laws = {}  # by number


class Law:
    file = "the law"
    module = law = None
    begun = False
    shape, length, commands, state_size = [], 0, 0, 0


def end_with_the_program():
    """Ends this process soon after rotorub has gone, also if the law never returns."""
    import select, time
    watch = select.poll()
    watch.register(CONNECTION, 0)
    watch.poll()
    time.sleep(1.0)
    os._exit(1)


def receive(count):
    parts = b""
    while len(parts) < count:
        part = os.read(CONNECTION, count - len(parts))
        if not part:
            return None
        parts += part
    return parts


def send(answer):
    answer = struct.pack("=I", len(answer)) + answer
    while answer:
        answer = answer[os.write(CONNECTION, answer):]


def function(of, name, arguments):
    found = getattr(of.module, name, None)
    if not callable(found):
        raise AttributeError(f"{of.file} has no function {name}({arguments})")
    return found


def forget_modules_in(folder):
    """What the law imports from its own folder is read again, so that every run begins alike."""
    for name, other in list(sys.modules.items()):
        if str(getattr(other, "__file__", None)).startswith(folder):
            del sys.modules[name]


def load(of, path):
    folder = os.path.dirname(path)
    if sys.path[:1] != [folder]:
        sys.path[:1] = [folder] + [other for other in sys.path[:1] if other]
    forget_modules_in(os.path.join(folder, ""))
    sys.argv = [path]
    of.file = path
    module = of.module = sys.modules["rotorub_law"] = type(sys)("rotorub_law")
    module.__file__ = path
    with open(path, "rb") as file:
        text = file.read()
    exec(compile(text, path, "exec"), module.__dict__)
    function(of, "create", "setup")
    function(of, "step", "law, now, state")
    command = getattr(module, "command", "force")
    if command not in ("force", "current"):
        raise ValueError(f'{path}: command is {command!r}; choose from "force", "current"')
    return command.encode()


def create(of, setup, shape, commands):
    of.commands = commands
    of.shape, of.length = [], 0
    for name, count in shape:
        numbers = count if isinstance(count, int) else 1
        of.shape.append((name, count, of.length, of.length + numbers))
        of.length += numbers
    of.law = of.module.create(setup)
    of.begun = True
    of.state_size = int(of.module.state_size(of.law)) if hasattr(of.module, "state_size") else 0
    if of.state_size < 0:
        raise ValueError(f"state_size() returns {of.state_size}; return 0 or more")
    state = bytearray(8 * of.state_size)
    if hasattr(of.module, "start"):
        with memoryview(state).cast("d") as view:
            of.module.start(of.law, view)
    return bytes(state)


def step(of, values, now):
    numbers = struct.unpack_from(f"={of.length}d", values)
    for name, count, first, last in of.shape:
        if count == "float":
            now[name] = numbers[first]
        elif count == "int":
            now[name] = int(numbers[first])
        else:
            now[name] = numbers[first:last]
    state = bytearray(values[8 * of.length:])
    with memoryview(state).cast("d") as view:
        command = of.module.step(of.law, now, view)
    try:
        command = [float(value) for value in command]
    except TypeError:
        raise TypeError(f"step() returns {type(command).__name__}; return {expected(of)}") from None
    if len(command) != of.commands:
        raise TypeError(f"step() returns {len(command)} numbers; return {expected(of)}")
    return struct.pack(f"={of.commands}d", *command) + state


def end(of):
    if of.begun and hasattr(of.module, "destroy"):
        of.module.destroy(of.law)
    return b""


def expected(of):
    return "two numbers, ux and uy" if of.commands == 2 else f"{of.commands} numbers, one current for each port"


def words_of(error, given, name, state_size):
    """The exception, the innermost places of the law that it came through, and what helps."""
    text = f"{type(error).__name__}: {error}"
    if isinstance(error, SyntaxError):
        return f"{type(error).__name__}: {error.msg} ({error.filename}:{error.lineno})"
    frames, trace = [], error.__traceback__
    while trace is not None:
        code = trace.tb_frame.f_code
        if code.co_filename != "<string>":
            frames.append((code.co_name, code.co_filename, trace.tb_lineno))
        trace = trace.tb_next
    import linecache
    for place, file, line in frames[-3:]:
        text += f", in {place} ({file}:{line})"
    if frames:
        source = linecache.getline(*frames[-1][1:]).strip()
        text += f": `{source}`" if source else ""
    if isinstance(error, KeyError) and error.args and given is not None and error.args[0] not in given:
        text += f"; {name} has the keys {', '.join(given)}"
        if "config" in given:
            text += f", and its config has {', '.join(given['config']) or 'nothing'}"
    if isinstance(error, IndexError) and state_size == 0:
        text += "; the state has no numbers: state_size(law) must return how many it needs"
    if isinstance(error, ModuleNotFoundError):
        text += f"; the law runs in {sys.executable}, and ROTORUB_PYTHON selects another Python"
    return text


def answer_to(request):
    kind, number, rest = request[:1], request[1:5], request[5:]
    given, name, state_size = None, "", None
    try:
        if kind == b"S":
            given, name, state_size = {}, "now", laws[number].state_size
            return b"\0" + step(laws[number], rest, given)
        if kind == b"E":
            return b"\0" + end(laws.pop(number))
        if kind == b"L":
            laws[number] = Law()
            return b"\0" + load(laws[number], os.fsdecode(rest))
        import json
        asked = json.loads(rest.decode("utf-8", "surrogateescape"))
        given, name = asked["setup"], "setup"
        return b"\0" + create(laws[number], given, asked["shape"], asked["commands"])
    except BaseException as error:
        return b"\1" + words_of(error, given, name, state_size).encode("utf-8", "backslashreplace")


sys.dont_write_bytecode = True
signal.signal(signal.SIGINT, signal.SIG_IGN)  # rotorub ends the run
_thread.start_new_thread(end_with_the_program, ())
while True:
    head = receive(4)
    request = head and receive(struct.unpack("=I", head)[0])
    if not request:
        break
    send(answer_to(request))
)python";
}

}  // namespace rotorub
