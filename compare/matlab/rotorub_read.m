function run = rotorub_read(folder)
% ROTORUB_READ  A run of rotorub as a struct; for MATLAB (R2016b or later) and Octave (7 or later).
%
%   run = rotorub_read('runs/paper_passive-native-verlet')
%
%   run.series.gap                   columns of series.csv; run.series.mode: a cell array of words
%   run.impacts.normal_impulse       impacts.csv
%   run.events.event                 events.csv, a cell array of words
%   run.keyphasor.rotor_x            keyphasor.csv: the places once a turn
%   run.units.series.gap             'm'; run.meanings.series.gap: what it is, and its sign
%   run.summary.mean_force           summary.json
%   run.scene                        text of scene.toml, '' for a machine of one's own
%
% Columns, units and signs: compare/study/README.md.

  if exist(fullfile(folder, 'summary.json'), 'file') ~= 2
    error('rotorub:read', '%s: no run: summary.json is missing', folder);
  end
  run.series = read_table(fullfile(folder, 'series.csv'), {'free', 'slide', 'stick'});
  run.impacts = read_table(fullfile(folder, 'impacts.csv'), {});
  run.events = read_table(fullfile(folder, 'events.csv'), {'impact', 'slide', 'stick', 'lift_off', 'reverse'});
  run.keyphasor = struct();  % a run of an earlier version has none
  if exist(fullfile(folder, 'keyphasor.csv'), 'file') == 2
    run.keyphasor = read_table(fullfile(folder, 'keyphasor.csv'), {});
  end
  run.summary = jsondecode(fileread(fullfile(folder, 'summary.json')));
  run.scene = '';
  if exist(fullfile(folder, 'scene.toml'), 'file') == 2
    run.scene = fileread(fullfile(folder, 'scene.toml'));
  end
  [run.units, run.meanings] = read_columns(fullfile(folder, 'columns.json'));
end

% A CSV file as a struct of columns. `words`: what the one column that holds no numbers may say.
function table = read_table(file, words)
  text = fileread(file);
  cut = find(text == sprintf('\n'), 1);
  if isempty(cut)
    error('rotorub:read', '%s: has no header line', file);
  end
  names = strsplit(text(1:cut - 1), ',');
  body = text(cut + 1:end);
  for k = 1:numel(words)
    body = strrep(body, [',' words{k}], sprintf(',%d', k));
  end
  % One number after another, each read to its last bit; a word that is left stops it.
  body(body == sprintf('\n')) = ',';
  values = sscanf(body, '%f,');
  if numel(values) ~= sum(body == ',') || mod(numel(values), numel(names)) ~= 0
    error('rotorub:read', '%s: %d numbers in rows of %d', file, numel(values), numel(names));
  end
  values = reshape(values, numel(names), [])';
  for k = 1:numel(names)
    if any(strcmp(names{k}, {'mode', 'event'}))
      table.(names{k}) = reshape(words(values(:, k)), [], 1);
    else
      table.(names{k}) = values(:, k);
    end
  end
end

% Units and meanings by file and column; empty for a folder of an earlier version.
function [units, meanings] = read_columns(file)
  units = struct('series', struct(), 'impacts', struct(), 'events', struct(), 'keyphasor', struct());
  meanings = units;
  if exist(file, 'file') ~= 2
    return
  end
  files = jsondecode(fileread(file));
  for table = {'series', 'impacts', 'events', 'keyphasor'}
    if ~isfield(files, [table{1} '_csv'])
      continue
    end
    columns = files.([table{1} '_csv']);
    for k = 1:numel(columns)
      units.(table{1}).(columns(k).name) = columns(k).unit;
      meanings.(table{1}).(columns(k).name) = columns(k).meaning;
    end
  end
end
